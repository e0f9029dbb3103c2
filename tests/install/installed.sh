#!/bin/bash
# installed.sh CMAKE BUILD SOURCES: an installed tree works where it was moved to, without the checkout and its build.
set -euo pipefail
cmake=$1 build=$2 sources=$3
place=$(mktemp -d)
trap 'rm -rf -- "$place"' EXIT

"$cmake" --install "$build" --prefix "$place/first" >"$place/install.log"
mv -- "$place/first" "$place/moved here"

cat >"$place/use.sh" <<'EOF'
set -euo pipefail
prefix=$1
cd -- "$2"
export PATH=$prefix/bin:/usr/bin:/bin
[[ ! -e $3/CMakeLists.txt ]] || echo "the checkout is in sight: no namespaces here"
ddem --version | grep -q '^ddem [0-9]'
ddem validate --only paper/random/dem/kt0.30 -o report
ddem report report -o again.html
ddem run "$prefix/share/ddem/harness/scenes/shear_ddem.toml" --json >run.json
ddem fem "$prefix/share/ddem/harness/scenes/continuum.toml" --signals fem.csv --json >fem.json
ddem validate --list "$prefix/share/ddem/harness/campaigns/strip.toml" >list.txt
for file in report/report.html again.html run.json fem.json fem.csv list.txt; do
  [[ -s $file ]] || { echo "no $file"; exit 1; }
done
# Paths and links of README and guide hold; contributing is of the sources.
(cd -- "$prefix/share/ddem"
 grep -oE '\]\([^)#:]+' README.md harness/guide/*.md | grep -vE 'contributing|\.ci/|LICENSE' | while IFS=: read -r page link; do
   [[ -e $(dirname -- "$page")/${link#"]("} ]] || { echo "$page: no ${link#"]("}"; exit 1; }
 done)
grep -q 'protocol 1' "$prefix/share/ddem/schemas/scene.schema.json"
bash -n "$prefix/share/bash-completion/completions/ddem"
bash -c 'source "$1"; COMP_WORDS=(ddem validate --res) COMP_CWORD=2; _ddem; [[ ${COMPREPLY[*]} == --resume ]]' - "$prefix/share/bash-completion/completions/ddem"
EOF
mkdir "$place/work"
arguments=("$place/moved here" "$place/work" "$sources")
if unshare -rm true 2>/dev/null; then
  unshare -rm bash -c 'mount -t tmpfs none "$4" && bash "$1" "$2" "$3" "$4"' - "$place/use.sh" "${arguments[@]}"
else
  bash "$place/use.sh" "${arguments[@]}"
fi
