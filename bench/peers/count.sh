#!/usr/bin/env bash
# Instructions a call, by callgrind, of Frankel's chain alone (no cylinders) in peers that are no Rust crates:
#   bench/peers/count.sh          Orocos KDL (Debian liborocos-kdl-dev) and Pinocchio (PyPI pin), as far as they are there
# Compare with `cargo hil bench`, whose maps include the cylinders and the four-bar.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
out=../../target/peers
mkdir -p "$out"
for tool in g++ valgrind python3; do
  command -v "$tool" >/dev/null || { echo "install $tool" >&2; exit 1; }
done

collected() { # program map count
  valgrind --tool=callgrind --callgrind-out-file=/dev/null "$@" 2>&1 | sed -n 's/.*Collected : *//p'
}

per_call() { # program map
  local fewer more
  fewer=$(collected "$1" "$2" 64)
  more=$(collected "$1" "$2" 128)
  echo $(((more - fewer) / 64))
}

report() { # name program
  local nothing forward inverse
  nothing=$(per_call "$2" nothing)
  forward=$(($(per_call "$2" forward) - nothing))
  inverse=$(($(per_call "$2" inverse) - nothing))
  awk -v name="$1" -v f="$forward" -v i="$inverse" -v of="$our_forward" -v oi="$our_inverse" \
    'BEGIN { printf "%-10s joints -> tip %7d (%.1f x ours)   tip -> joints %9d (%.1f x ours)\n", name, f, f / of, i, i / oi }'
}

# Ours, cylinders included, in f64 as the peers.
cargo build --quiet --release --package bench --bin host-maps
ours=$(cargo metadata --no-deps --format-version 1 | sed -n 's/.*"target_directory":"\([^"]*\)".*/\1/p')/release/host-maps
nothing=$(per_call "$ours" nothing)
our_forward=$(($(per_call "$ours" cylinders_to_tip_f64) - nothing))
our_inverse=$(($(per_call "$ours" tip_to_cylinders_f64) - nothing))
printf '%-10s cylinders -> tip %d   tip -> cylinders %d\n' ours "$our_forward" "$our_inverse"

eigen=$(ls -d /usr/include/eigen3 2>/dev/null || true)
if [ -n "$eigen" ] && [ -d /usr/include/kdl ]; then
  echo "building KDL's program" >&2
  g++ -O2 -std=c++17 -DNDEBUG -isystem "$eigen" kdl.cpp -lorocos-kdl -o "$out/kdl"
  report KDL "$out/kdl"
else
  echo "KDL left out: apt-get install liborocos-kdl-dev libeigen3-dev" >&2
fi

if [ ! -d "$out/venv" ]; then
  echo "installing Pinocchio from PyPI" >&2
  python3 -m venv "$out/venv" && "$out/venv/bin/pip" install --quiet pin || { rm -rf "$out/venv"; }
fi
prefix=$(find "$out/venv" -type d -name cmeel.prefix -prune 2>/dev/null | head -n 1 || true)
if [ -n "$prefix" ] && [ -n "$eigen" ]; then
  echo "building Pinocchio's program (about a minute)" >&2
  library=$(cd "$prefix/lib" && pwd)
  g++ -O2 -std=c++17 -DNDEBUG -DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS -DBOOST_MPL_LIMIT_LIST_SIZE=30 \
    -DBOOST_MPL_LIMIT_VECTOR_SIZE=30 -isystem "$eigen" -isystem "$prefix/include" pinocchio.cpp \
    -L"$library" -Wl,-rpath,"$library" -lpinocchio_default -o "$out/pinocchio"
  report Pinocchio "$out/pinocchio"
else
  echo "Pinocchio left out: it needs PyPI's package pin and Debian's libeigen3-dev" >&2
fi
