#!/bin/bash
# launcher.sh LAUNCHER
set -euo pipefail
root=$(mktemp -d)
trap 'rm -rf -- "$root"' EXIT
launcher=$1
calls=$root/calls bin=$root/tools

# tool FILE: a script from standard input.
tool() {
  mkdir -p -- "$(dirname -- "$1")"
  { echo '#!/bin/bash'; cat; } >"$1"
  chmod +x "$1"
}

tool "$bin/sudo" <<<'exit 1'  # one that would ask for a password
tool "$bin/cmake" <<'END'
if [[ -e lacks-packages ]]; then until grep -q later "$CALLS"; do sleep 0.01; done; fi
echo "cmake" >>"$CALLS"
mkdir -p build/release/share/ddem
touch build/release/share/ddem/plotly-cartesian.min.js
echo CMAKE_HOME_DIRECTORY:INTERNAL="$PWD" >build/release/CMakeCache.txt
: >build/release/build.ninja
if [[ ! -e lacks-packages ]]; then printf 'build ddem-fem: x\nbuild ddem-lammps: x\n' >build/release/build.ninja; fi
END
tool "$bin/ninja" <<'END'
echo "ninja ${*:3}" >>"$CALLS"
[[ ! -e compiler-fails ]] || exit 1
mkdir -p "$2/bin"
for target in "${@:3}"; do
  case $target in ddem | ddem-fem | ddem-lammps)
    printf '#!/bin/sh\n' >"$2/bin/$target"
    chmod +x "$2/bin/$target" ;;
  esac
done
END

# A checkout of which nothing is built.
checkout() {
  rm -rf -- "$root/clone"
  mkdir -p "$root"/clone/{dem,fem_reference,harness,meshes,reports,.ci/cmake}
  cd -- "$root/clone"
  touch CMakeLists.txt CMakePresets.json .ci/packages{,-later,-tests}.txt
  cp -- "$launcher" ddem
  tool .ci/install <<'END'
if [[ $1 == --missing ]]; then
  if [[ -e lacks-packages ]]; then echo libdeal.ii-dev; fi
  exit
fi
echo "install $*" >>"$CALLS"
if [[ $* == *later* ]]; then
  [[ ! -e offline ]] || exit 4
  # Packages that are missing come when the compiler has begun.
  if [[ -e lacks-packages && $* != *packages.txt* ]]; then until grep -q ddem_fem_cases "$CALLS"; do sleep 0.01; done; fi
  rm -f lacks-packages
fi
END
}

# expect CODE CALLS ARGUMENT ...: the launcher's exit code, and what it asked for, lines joined by "; ".
expect() {
  local code=0
  : >"$calls"
  CALLS=$calls PATH=$bin:$PATH ./ddem "${@:3}" >"$root/said" 2>&1 || code=$?
  local asked
  asked=$(paste -sd ';' -- "$calls")
  if [[ $code != "$1" || $asked != "$2" ]]; then
    printf './ddem %s: exit code %s, asked for\n  %s\nnot %s,\n  %s\n' "${*:3}" "$code" "$asked" "$1" "$2"
    cat -- "$root/said"
    exit 1
  fi
}
both="install .ci/packages.txt .ci/packages-later.txt"
begun="ninja ddem_dem ddem_packings ddem_fem_cases"

# Packages that are there: built once, and not again.
checkout
expect 0 "$both;cmake;ninja ddem ddem-fem" validate
expect 0 "" validate

# ddem-lammps: where it is named, in a file as well, and from then on.
expect 0 "$both;ninja ddem ddem-fem ddem-lammps ddem-lammps-styles" run scene.toml --solver lammps-ddem
expect 0 "" run scene.toml
sleep 0.01 && touch dem
expect 0 "$both;ninja ddem ddem-fem ddem-lammps ddem-lammps-styles" run scene.toml
checkout
echo 'solver = "lammps-ddem"' >night.toml
expect 0 "$both;cmake;ninja ddem ddem-fem ddem-lammps ddem-lammps-styles" validate night.toml

# Packages that are missing. As root the compiler begins before they are there, and CMake looks again when they are; who would be
# asked for a password is asked once, at first.
checkout
touch lacks-packages
if ((EUID == 0)); then
  expect 0 "install .ci/packages.txt;install .ci/packages-later.txt;cmake;$begun;cmake;ninja ddem ddem-fem" validate
  # Without a network it ends with its code, and begins anew the next time.
  checkout
  touch lacks-packages offline
  expect 4 "install .ci/packages.txt;install .ci/packages-later.txt;cmake;$begun" validate
  [[ ! -e build/release/.built ]]
  rm offline
  expect 0 "install .ci/packages.txt;install .ci/packages-later.txt;cmake;$begun;cmake;ninja ddem ddem-fem" validate
else
  expect 0 "$both;cmake;ninja ddem ddem-fem" validate
fi

# A compiler that fails.
checkout
touch compiler-fails
expect 4 "$both;cmake;ninja ddem ddem-fem" validate
[[ ! -e build/release/.built ]]
rm compiler-fails
expect 0 "$both;ninja ddem ddem-fem" validate
