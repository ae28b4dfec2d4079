//! `sweep`: many designs, written as they come.

use std::{
    fs::File,
    io::{BufRead, BufReader, Seek, SeekFrom, Write},
    path::PathBuf,
    sync::atomic::Ordering,
};

use bogie::{
    design::sweep,
    export,
    optimize::journal::Journal,
    run::{Journaled, Progress, Run},
};
use rayon::prelude::*;

use super::{
    Done, Failure,
    arguments::{Lines, Sweep},
    design, input, interrupt, output,
    progress::Line,
};

/// Designs that a thread evaluates and puts into lines before it takes others.
const BLOCK: usize = 16;
/// Designs that are held at once, whatever the number asked for.
const CHUNK: usize = 1024;

pub fn sweep(call: &Sweep) -> Result<Done, Failure> {
    let input = input::read(&call.source.spec)?;
    let run = Run::new(&input);
    let indices = run.asked(&design::indices(&call.indices)?);
    let seed = call.seed.unwrap_or(input.spec.design.seed);
    let sweep = run
        .sweep(&indices, seed)
        .map_err(|error| Failure::design(&call.source.spec, error))?;
    let request = Journaled::Sweep {
        indices: &indices,
        seed,
        form: &call.format.to_string(),
    };
    let mut place = Place::new(call, run, request)?;
    let begun = place.begun;
    if begun == 0 {
        place.write(&lines(call.format, &sweep, &[], true))?;
    }
    let progress = Line::new();
    progress.stage("sweep");
    progress.expected(call.designs.saturating_sub(begun));
    let done = place.fill(call, &sweep, &progress);
    progress.finish();
    let done = done?;
    let whole = done >= call.designs;
    place.finish(whole)?;
    if !whole {
        output::say(format_args!(
            "ended early: interrupted after {done} designs"
        ));
    }
    Ok(Done::of(!whole, true))
}

/// Designs as lines; the head line before them or not.
fn lines(format: Lines, sweep: &sweep::Sweep, designs: &[sweep::Design], head: bool) -> Vec<u8> {
    let table = export::sweep::table(sweep, designs);
    match format {
        Lines::Csv => {
            let mut text = table.csv();
            if !head {
                let end = text.find('\n').map_or(0, |end| end + 1);
                text.drain(..end);
            }
            text.into_bytes()
        }
        Lines::Json => table.json_lines().into_bytes(),
    }
}

/// Where the lines go: standard output, or a file that gets its name when it is whole.
struct Place {
    file: Option<Partial>,
    /// Designs that an earlier run has left.
    begun: usize,
}

struct Partial {
    file: File,
    path: PathBuf,
    whole: PathBuf,
    /// Keeps other runs out of the folder, and tells which run the lines belong to.
    _journal: Journal,
}

impl Place {
    fn new(call: &Sweep, run: Run, request: Journaled) -> Result<Self, Failure> {
        let Some(folder) = &call.out else {
            return Ok(Self {
                file: None,
                begun: 0,
            });
        };
        output::ready(folder)?;
        let journal = design::journal(run, request, folder, call.resume)?.0;
        let whole = folder.join(format!("sweep.{}", call.format));
        let path = folder.join(format!("sweep.{}.partial", call.format));
        let cannot = |error| output::cannot_write(&path, &error);
        let heads = usize::from(call.format == Lines::Csv);
        let mut begun = 0;
        // What is whole may be the beginning of something longer.
        if call.resume && !path.exists() && whole.exists() {
            std::fs::copy(&whole, &path).map_err(cannot)?;
        }
        let mut options = File::options();
        let mut file = options
            .read(true)
            .write(true)
            .create(true)
            .truncate(!call.resume)
            .open(&path)
            .map_err(cannot)?;
        if call.resume {
            let (count, length) = whole_lines(&file, call.designs + heads).map_err(cannot)?;
            begun = count.saturating_sub(heads);
            // A head line alone is written again.
            file.set_len(if begun > 0 { length } else { 0 })
                .map_err(cannot)?;
            file.seek(SeekFrom::End(0)).map_err(cannot)?;
        }
        Ok(Self {
            file: Some(Partial {
                file,
                path,
                whole,
                _journal: journal,
            }),
            begun,
        })
    }

    /// Evaluates the designs that are not there yet; the number of the last one written.
    fn fill(
        &mut self,
        call: &Sweep,
        sweep: &sweep::Sweep,
        progress: &Line,
    ) -> Result<usize, Failure> {
        let interrupted = interrupt::flag();
        let mut done = self.begun;
        while done < call.designs && !interrupted.load(Ordering::Relaxed) {
            let (start, end) = (done + 1, (done + CHUNK).min(call.designs) + 1);
            let starts: Vec<usize> = (start..end).step_by(BLOCK).collect();
            let blocks: Vec<Option<Vec<u8>>> = starts
                .into_par_iter()
                .map(|start| {
                    if interrupted.load(Ordering::Relaxed) {
                        return None;
                    }
                    let designs = sweep.designs(start..(start + BLOCK).min(end));
                    for _ in &designs {
                        progress.evaluated();
                    }
                    Some(lines(call.format, sweep, &designs, false))
                })
                .collect();
            for block in blocks.into_iter().map_while(|block| block) {
                self.write(&block)?;
                done = (done + BLOCK).min(end - 1);
            }
        }
        Ok(done)
    }

    fn write(&mut self, lines: &[u8]) -> Result<(), Failure> {
        match &mut self.file {
            // A head without names is no line.
            _ if lines.is_empty() => Ok(()),
            None => output::part(lines),
            Some(partial) => partial
                .file
                .write_all(lines)
                .map_err(|error| output::cannot_write(&partial.path, &error)),
        }
    }

    /// Gives a whole file its name.
    fn finish(self, whole: bool) -> Result<(), Failure> {
        let Some(partial) = self.file else {
            return Ok(());
        };
        let cannot = |error| output::cannot_write(&partial.whole, &error);
        partial.file.sync_all().map_err(cannot)?;
        let name = if whole {
            std::fs::rename(&partial.path, &partial.whole).map_err(cannot)?;
            &partial.whole
        } else {
            &partial.path
        };
        output::say(format_args!("wrote {}", name.display()));
        Ok(())
    }
}

/// Number of whole lines in a file, up to `most`, and their length.
fn whole_lines(file: &File, most: usize) -> std::io::Result<(usize, u64)> {
    let mut reader = BufReader::new(file);
    let (mut count, mut length) = (0, 0);
    let mut line = Vec::new();
    while count < most {
        line.clear();
        let read = reader.read_until(b'\n', &mut line)?;
        if line.last() != Some(&b'\n') {
            break;
        }
        count += 1;
        length += read as u64;
    }
    Ok((count, length))
}
