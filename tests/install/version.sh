#!/bin/bash
# version.sh CMAKE SOURCE: what a build says of its version and commit, in repositories made for it: tagged, after a tag, changed,
# wrongly tagged, within another repository, and none.
set -euo pipefail
cmake=$1 source=$2
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
export GIT_CEILING_DIRECTORIES=$work GIT_CONFIG_GLOBAL=/dev/null GIT_CONFIG_SYSTEM=/dev/null
export GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a@example.org GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a@example.org

failed=0
expect() {  # WHAT IS EXPECTED
  if [[ $2 != "$3" ]]; then echo "$1: \"$2\", expected \"$3\"" >&2; failed=1; fi
}
project() {  # FOLDER
  mkdir -p -- "$1"
  printf '%s\n' 'cmake_minimum_required(VERSION 3.25)' 'project(x VERSION 1.2.0 LANGUAGES NONE)' \
    "include($source/.ci/cmake/DdemVersion.cmake)" 'message(STATUS "version=${DDEM_VERSION}")' >"$1/CMakeLists.txt"
}
version() { "$cmake" -S "$1" -B "$1.build" 2>&1 | sed -n 's/^-- version=//p' || true; }
commit() {
  rm -f -- "$work/commit"
  "$cmake" -D GIT=git -D "SOURCE=$1" -D "FILE=$work/commit" -P "$source/.ci/cmake/WriteCommit.cmake"
  cat -- "$work/commit"
}

repository=$work/repository
project "$repository"
git -C "$repository" init -q
git -C "$repository" add -A
git -C "$repository" commit -qm one
hash() { git -C "$repository" rev-parse --short=12 HEAD; }
expect "without a tag" "$(version "$repository")" 1.2.0
expect "commit" "$(commit "$repository")" "$(hash)"
git -C "$repository" tag v1.2.0
expect "at the tag" "$(version "$repository")" 1.2.0
expect "commit at the tag" "$(commit "$repository")" "$(hash)"
git -C "$repository" commit -q --allow-empty -m two
expect "after the tag" "$(version "$repository")" "1.2.0+1.g$(git -C "$repository" rev-parse --short HEAD)"
echo "# changed" >>"$repository/CMakeLists.txt"
expect "commit of changed files" "$(commit "$repository")" "$(hash) with changes"
git -C "$repository" tag v1.3.0
expect "at a tag of another version" "$(version "$repository")" ""
project "$repository/copy"
expect "within another repository" "$(version "$repository/copy")" 1.2.0
"$cmake" --build "$repository/copy.build" --target help | grep -q commit && { echo "a copy within another repository tells its commit" >&2; failed=1; }
project "$work/plain"
expect "without a repository" "$(version "$work/plain")" 1.2.0
expect "commit without a repository" "$(commit "$work/plain")" ""
exit "$failed"
