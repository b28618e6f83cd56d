#!/usr/bin/env bash
#
# Prints twenty comments of each room of the library, drawn at random, with the place where they
# stand: to be read by somebody who knows deal.II and not this library. A comment that is not
# understood at once is rewritten, and the room is read as a whole if that happens twice.
#
#   tests/words/random-comments.sh [SEED [ROOM]...]     the seed is 1, and all rooms are read

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

seed=${1:-1}
shift || true
rooms=("$@")
[[ ${#rooms[@]} -gt 0 ]] || mapfile -t rooms < <(ls include/nmm)

for room in "${rooms[@]}"; do
  printf '\n== %s (seed %s)\n' "$room" "$seed"
  mapfile -t files < <(find "include/nmm/$room" "source/$room" -name '*.h' -o -name '*.cc' | sort)
  # A comment is a run of lines that have nothing else on them; single words are left out.
  awk -v seed="$seed" '
    BEGIN { srand(seed) }
    function finish() {
      if (split(text, words, " ") > 3)
        comments[n++] = where ": " text
      text = ""
    }
    FNR == 1 { finish() }
    /^[ \t]*(\/\/|\/\*\*|\*)/ {
      line = $0
      sub(/^[ \t]*(\/\/[\/]?|\/\*\*|\*\/?)[ \t]*/, "", line)
      if (text == "") where = FILENAME ":" FNR
      text = text (text == "" ? "" : " ") line
      next
    }
    { finish() }
    END {
      finish()
      for (i = 0; i < 20 && n > 0; ++i) {
        k = int(rand() * n)
        print comments[k] "\n"
        comments[k] = comments[--n]
      }
    }' "${files[@]}"
done
