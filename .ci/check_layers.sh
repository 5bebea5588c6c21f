#!/usr/bin/env bash
# The rules of the house that no compiler knows:
#
# - arrows point left: core < posix < namelist < numerics < formulas < systems < tables < references, integrators
#   < oscillations < observers < catalogue < audit < grading < principles < derivation < scenes < runs < ensembles < pages < bench < stress
#   < commands < app. src/lagrangia.f90 uses what it likes; nobody uses it.
# - integrators and observers name no concrete system, observers no concrete integrator.
# - only app/ and src/commands/ print or stop; lagrangia_console, which knows how, is theirs.
# - no threads in src/ but those of src/bench: gfortran keeps the lengths of texts that functions return in static
#   variables. lagrangia_workers shares work among processes.
# - fpm.toml has the preprocessor read all sources: no line ends in a backslash, none has a slash and an
#   asterisk in a row. It would join lines, or take what follows for a comment.
# - src/ROOM/NAME.f90 holds one module, lagrangia_NAME, in at most 450 lines; app/main.f90 in 100.
#
#   check_layers.sh [DIRECTORY]        the project, by default the one this script lies in
set -u
cd "${1:-$(dirname "$0")/..}" || exit 2

mapfile -t files < <(find src app test -name build -prune -o -name '*.[fF]90' -print 2>/dev/null | sort)
if [ ${#files[@]} -eq 0 ]; then
    echo "no Fortran files in $PWD" >&2
    exit 1
fi

# Twice over the same files: first who defines what, then who uses what.
awk '
function complain(text) { print name (row ? ":" row : "") ": " text; bad++ }

function room_of(path, parts) {
    if (path == "src/lagrangia.f90") return "face"
    split(path, parts, "/")
    return parts[1] == "src" ? parts[2] : parts[1]
}

function code(line, result, position, quote) {  # without strings and comments, in lower case
    result = ""
    while (match(line, /["\047!]/)) {
        position = RSTART
        quote = substr(line, position, 1)
        result = result substr(line, 1, position - 1)
        if (quote == "!") return tolower(result)
        line = substr(line, position + 1)
        position = index(line, quote)
        if (position == 0) return tolower(result "\"\"")
        result = result "\"\""
        line = substr(line, position + 1)
    }
    return tolower(result line)
}

function may_use(user, used) {
    if (used == "face") return user == "app" || user == "test"
    if (user == "face" || user == "test" || user == used) return 1
    return level[used] < level[user]
}

function examine(statement, head, word, used) {
    sub(/^ +/, "", statement)
    head = statement
    if (head ~ /^if *\(/ && match(head, /\) *(print|write|(error +)?stop|call)[^a-z0-9_]/)) {
        head = substr(head, RSTART + 1)
        sub(/^ +/, "", head)
    } else if (head ~ /^if *\(.*\) *(error *)?stop$/) head = "stop"
    if (statement ~ /^(end *)?(sub)?module +[a-z(]/ && statement !~ /^(end|module +(procedure|subroutine|function|pure|elemental|recursive|impure)[ ])/) {
        word = statement
        sub(/^submodule *\([^)]*\) */, "", word)
        sub(/^module +/, "", word)
        gsub(/ /, "", word)
        if (pass == 1) {
            modules[name]++
            file_of[word] = name
            room_defining[word] = room
            if (room != "test" && room != "app") {
                if (word != expected) complain("module " word " should be called " expected)
                if (modules[name] > 1) complain("a second module in one file: " word)
            }
        }
        return
    }
    if (pass == 1) {
        if (statement ~ /extends *\( *[a-z_]*system_t *\)/ && statement !~ /abstract/) concrete_system[name] = 1
        if (statement !~ /abstract/ && statement ~ /extends *\( *integrator_t *\)/) concrete_integrator[name] = 1
        return
    }
    if (room == "test") return
    if (statement ~ /^use( |,|::)/ && statement !~ /^use *(=|\()/) {
        used = statement
        sub(/^use */, "", used)
        if (used ~ /^, *intrinsic/) {
            if (prints_not[room] && expected != "lagrangia_console" && used ~ /iso_fortran_env/ && used ~ /(output|error)_unit/)
                complain("only app/ and src/commands/ print: " statement)
            return
        }
        sub(/^(, *non_intrinsic *)?(:: *)?/, "", used)
        sub(/[^a-z0-9_].*$/, "", used)
        if (used == "omp_lib") return
        if (used == "lagrangia_c_library" && expected != "lagrangia_console" && expected != "lagrangia_workers" && statement ~ /[ ,]c_(write|fdopen)( |,|$)/)
            complain("only app/ and src/commands/ print: " statement)
        if (!(used in room_defining)) {
            complain("no file here defines the module " used)
        } else if (!may_use(room, room_defining[used])) {
            complain(room " may not use " room_defining[used] ": " used)
        } else if (used == "lagrangia_console" && prints_not[room] && room != "posix") {
            complain("only app/ and src/commands/ print: " used)
        } else if ((room == "integrators" || room == "observers") && file_of[used] in concrete_system) {
            complain(room " may not name a concrete system: " used)
        } else if (room == "observers" && file_of[used] in concrete_integrator) {
            complain("observers may not name a concrete integrator: " used)
        }
    } else if (prints_not[room]) {
        if (head ~ /^print *(\*|"|[a-z_0-9]+ *(,|$)|$)/ ||
            head ~ /^write *\( *(unit *= *)?(\*|6 *[,)]|0 *[,)]|output_unit|error_unit)/)
            complain("only app/ and src/commands/ print: " statement)
        if ((head ~ /^(error *)?stop( |"|,|$)/ && head !~ /^stop *=/) || head ~ /^call *(exit|abort) *(\(|$)/)
            complain("only app/ and src/commands/ stop: " statement)
    }
}

BEGIN {
    rooms = split("core posix namelist numerics formulas systems tables middle oscillations observers catalogue audit grading principles derivation" \
                  " scenes runs ensembles pages bench stress commands app", order, " ")
    for (i = 1; i <= rooms; i++) {
        level[order[i]] = i
        prints_not[order[i]] = order[i] != "commands" && order[i] != "app"
    }
    split("references integrators", middle, " ")
    for (i in middle) {
        level[middle[i]] = level["middle"]
        prints_not[middle[i]] = 1
    }
    delete level["middle"]
    prints_not["face"] = 1
}

FNR == 1 {
    name = FILENAME
    room = room_of(name)
    expected = name
    sub(/^.*\//, "", expected)
    sub(/\.[fF]90$/, "", expected)
    expected = tolower(room == "face" ? "lagrangia" : "lagrangia_" expected)
    pending = ""
    if (pass == 1 && room != "test" && room != "face" && !(room in level))
        complain("no such room: " room)
}

{
    row = FNR
    if (pass == 1) {
        lines[name] = FNR
        if ($0 ~ /\\$/) complain("the preprocessor joins a line that ends in a backslash")
        if (tolower($0) ~ /^ *!\$omp/ && room != "bench" && room != "test") complain("threads share the lengths of texts: use lagrangia_workers")
        if (index($0, "/" "*")) complain("the preprocessor takes this for a comment: /" "*")
    }
    line = code($0)
    if (line ~ /^ *$/) next
    sub(/ +$/, "", line)
    sub(/^ *& */, "", line)
    line = pending line
    if (line ~ /&$/) { pending = substr(line, 1, length(line) - 1); next }
    pending = ""
    count = split(line, statements, ";")
    for (i = 1; i <= count; i++) examine(statements[i])
}

END {
    row = 0
    for (i = 2; ARGV[i] != "pass=2"; i++) {
        name = ARGV[i]
        room = room_of(name)
        limit = name == "app/main.f90" ? 100 : 450
        if (lines[name] > limit && name !~ /^test\/funit\//) complain("more than " limit " lines")
        if (room != "test" && room != "app" && !modules[name]) complain("no module here")
    }
    if (bad) print bad (bad == 1 ? " rule broken" : " rules broken")
    exit bad > 0
}
' pass=1 "${files[@]}" pass=2 "${files[@]}"
