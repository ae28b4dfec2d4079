#!/bin/sh
# Prints every number of docs/src/speed.md anew, as Markdown: sh benches/speed.sh
#
# Wants an idle machine, Python with benches/numpy/requirements.txt, and GNU time; what is missing is
# left out. The second processor is used where one is enough.
set -eu
cd "$(dirname "$0")/.."

echo "## Machine"
lscpu | sed -n 's/^Model name: *//p'
echo "$(nproc) cores; load $(cut -d ' ' -f 1 /proc/loadavg); $(rustc --version)"

cargo build --release --quiet
cargo bench --quiet --no-run

echo "## Parts"
taskset -c 1 cargo bench --quiet --bench evaluate -- --skip chart_grid --sample-count 300 --min-time 1
cargo bench --quiet --bench evaluate -- chart_grid

echo "## Beside NumPy"
if python3 -c "import numpy, scipy" 2> /dev/null; then
    taskset -c 1 python3 benches/numpy/compare.py
fi

echo "## Floor"
taskset -c 1 cargo bench --quiet --bench floor

echo "## Instructions"
cargo bench --quiet --bench instructions | sed -n '/^| part/,$p'

echo "## Sweeps"
echo "| indices | designs | by the clock, s | processor, s | processor, µs per design | peak memory, MB |"
echo "|---|---|---|---|---|---|"
sweep() {
    /usr/bin/time -o target/time.txt -f "%e %U %M" \
        target/release/bogie sweep "$2" --designs "$3" $4 > target/sweep.csv 2> /dev/null
    awk -v name="$1" -v n="$3" \
        '{ printf "| %s | %d | %.2f | %.2f | %.0f | %.1f |\n", name, n, $1, $2, 1e6 * $2 / n, $3 / 1024 }' \
        target/time.txt
}
for designs in 100 10000 100000; do
    sweep full problems/intercity-130mph.toml $designs ""
done
sed '/^\[requirements\]/,$d' problems/intercity-130mph.toml > target/sweep.toml
sweep "degree curve" target/sweep.toml 1000000 "--indices degree_curve"
rm -f target/sweep.toml target/sweep.csv target/time.txt
