#!/usr/bin/env bash
# The files of data/ that the program carries with it, as C: src/posix/shipped_files.c.
#
#   .ci/embed.sh            write that source
#   .ci/embed.sh --check    say whether it holds what is in data/ now
#
# A program that was installed finds no checkout, and fpm has no step before its build: so the
# texts are in a source, made here. Everything in the folders below is carried, but for programs.
set -u
cd "$(dirname "$0")/.." || exit 2
export LC_ALL=C
folders=(homework reference scenes sweeps templates)
target=src/posix/shipped_files.c

sources() {
    local folder
    for folder in "${folders[@]}"; do
        [ -d "data/$folder" ] && find "data/$folder" -type f ! -name '*.py' ! -name '.*' ! -name '*~'
    done | sort
}

literal() { # the lines of a file as C's string literals
    sed -e 's/\\/\\\\/g' -e 's/"/\\"/g' -e 's/?/\\?/g' -e 's/\t/\\t/g' -e 's/\r/\\r/g' \
        -e 's/.*/        "&\\n"/' "$1"
}

write() {
    local file
    cat <<'C'
/* The files of data/ that the program carries with it. Made by .ci/embed.sh, which says why: change
 * the files, not this. */
#include <stddef.h>

const char *lagrangia_shipped_file(int i, int part);

static const char *const files[][2] = {
C
    while IFS= read -r file; do
        printf '    {"%s",\n' "$file"
        literal "$file"
        echo '    },'
    done
    cat <<'C'
};

/* The path (part 0) or the text (part 1) of file i, from 0; NULL where there is none. */
const char *lagrangia_shipped_file(int i, int part)
{
    if (i < 0 || i >= (int)(sizeof files / sizeof *files)) return NULL;
    return files[i][part];
}
C
}

while IFS= read -r file; do # sed would add a line's end, and C ends a text at a NUL
    [ -s "$file" ] && [ -z "$(tail -c 1 "$file")" ] && [ "$(tr -d '\0' <"$file" | wc -c)" -eq "$(wc -c <"$file")" ] || {
        echo "$file: is empty, holds a NUL byte, or its last line has no end"
        exit 1
    }
done < <(sources)
case ${1:-} in
    "") sources | write >"$target.new" && mv "$target.new" "$target" ;;
    --check)
        sources | write | diff "$target" - >/dev/null || {
            echo "$target is not what is in data/: bash .ci/embed.sh"
            exit 1
        }
        ;;
    *) echo "usage: .ci/embed.sh [--check]" >&2; exit 2 ;;
esac
