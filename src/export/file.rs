//! Writing results: whole or not at all.

use std::{
    io::{self, Write},
    path::Path,
};

/// Makes sure that files can be written into a folder, before the work for them begins.
///
/// # Errors
///
/// Any error of the file system.
pub fn ready(folder: &Path) -> io::Result<()> {
    std::fs::create_dir_all(folder)?;
    tempfile::tempfile_in(folder)?;
    Ok(())
}

/// Writes a file under a temporary name beside its place and renames it when it is whole.
///
/// # Errors
///
/// Any error of the file system; the old file, if there was one, is then untouched.
pub fn write(path: &Path, content: impl AsRef<[u8]>) -> io::Result<()> {
    let folder = path
        .parent()
        .filter(|p| !p.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder)?;
    let mut builder = tempfile::Builder::new();
    // A result is for everybody whom the user's mask lets read it.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(folder)?;
    file.write_all(content.as_ref())?;
    file.as_file().sync_all()?;
    file.persist(path)?;
    Ok(())
}
