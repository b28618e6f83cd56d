#!/usr/bin/env bash
#
# Prints what doxygen warns about, and the public symbols of the library without a docstring; 1 if
# there is anything to print. Needs doxygen.
#
#   tests/words/undocumented-symbols.sh

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# warn NAME [SETTING]...: the warnings of doc/Doxyfile with other settings, into a file
warn() {
  local name=$1
  shift
  { cat doc/Doxyfile; printf '%s\n' "OUTPUT_DIRECTORY = $folder" "WARN_LOGFILE = $folder/$name" "$@"; } \
    >"$folder/Doxyfile"
  doxygen "$folder/Doxyfile" >/dev/null
}

warn pages.txt
warn symbols.txt 'INPUT = include' 'USE_MDFILE_AS_MAINPAGE =' 'GENERATE_HTML = NO' \
  'EXTRACT_ALL = NO' 'WARN_IF_UNDOCUMENTED = YES'
cat "$folder/pages.txt" "$folder/symbols.txt" | sed "s#^$PWD/##" | tee "$folder/all.txt"
[[ ! -s $folder/all.txt ]]
