#!/usr/bin/env bash
# Sweeps on coarray images: the same bytes from one process, two images and three, but for the line
# that names the build (OpenCoarrays cannot run one); an image that is killed loses at most one block; bad input is told once.
# The caf program is built here, beside the release build that is there.
#
#     .ci/try_images.sh             needs caf and cafrun (./setup.sh --cluster); else says so
#     .ci/try_images.sh --scaling   only the times of one image's work by one process and two images, of
#                                   twice as much by two, of a trajectory, and of a block that is dealt:
#                                   of use where nothing else runs
set -u
cd "$(dirname "$0")/.." || exit 2
if ! command -v caf >/dev/null || ! command -v mpirun >/dev/null; then
    echo "not run: there is no OpenCoarrays here (./setup.sh --cluster)"
    exit 0
fi
unset FPM_FFLAGS
export OPENBLAS_NUM_THREADS=1
program=$(fpm run --profile release --runner echo | tail -n 1)
images=$(fpm run --profile release --compiler caf --flag "-fcoarray=lib" --runner echo | tail -n 1)
[ -x "$program" ] && [ -x "$images" ] || { echo "FAILED  a program was not built"; exit 1; }
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
failed=0
options=(--oversubscribe)
[ "$(id -u)" -eq 0 ] && options+=(--allow-run-as-root)

check() { # check CLAIM COMMAND...
    if "${@:2}"; then echo "ok      $1"; else echo "FAILED  $1"; failed=$((failed + 1)); fi
}

on() { # on N FOLDER WORDS...: a sweep on N images; 0: by one process of the plain build
    if [ "$1" -eq 0 ]; then
        timeout 300 "$program" sweep "${@:3}" --threads 1 --output "$work/$2" >"$work/out" 2>"$work/err" </dev/null
    else
        timeout 300 mpirun -n "$1" "${options[@]}" "$images" sweep "${@:3}" --output "$work/$2" \
            >"$work/out" 2>"$work/err" </dev/null
    fi
}

same() { # same FILE FOLDERS...: it has the same bytes in all of them, but for the build
    local folder
    for folder in "${@:3}"; do
        cmp <(grep -av '^# build: ' "$work/$2/$1") <(grep -av '^# build: ' "$work/$folder/$1") || return 1
    done
}

if [ "${1:-}" = --scaling ]; then
    seconds() { # seconds N WORDS...: that a sweep takes, the least of three
        local i
        for i in 1 2 3; do
            rm -rf "$work/scaling"
            on "$1" scaling "${@:2}" --json
            sed -nE 's/.*"seconds": *([0-9.eE+-]+).*/\1/p' "$work/out"
        done | sort -g | head -n 1
    }
    half=(flip_map --over theta1=-pi:pi:400 --over theta2=0.0078:pi:200)
    whole=(flip_map)
    a=$(seconds 0 "${half[@]}") b=$(seconds 0 "${whole[@]}")
    c=$(seconds 2 "${whole[@]}")
    cat >"$work/deals.f90" <<'END'
program deals
    !! What it takes an image to be given a block, in us: alone, and where all ask at once.
    use, intrinsic :: iso_fortran_env, only: int64, real64
    use lagrangia_images, only: begin_dealing, deal, image_count, image_number, wait_for_all
    implicit none (type, external)
    integer(int64) :: finish, i, number, rate, start
    integer, parameter :: times = 20000
    integer :: asking

    do asking = 1, image_count(), max(1, image_count() - 1)
        call begin_dealing()
        call system_clock(start, rate)
        do i = 1, merge(times, 0, image_number() > image_count() - asking)
            call deal(number)
        end do
        call system_clock(finish)
        call wait_for_all()
        if (image_number() == image_count()) print "(i0, a, i0, a, f0.2, a)", asking, " of ", &
            image_count(), " images asking: ", 1e6_real64*(finish - start)/rate/times, " us a block"
    end do
end program deals
END
    for n in 2 3; do
        (cd "$work" && caf -O2 "$OLDPWD/src/core/kinds.F90" "$OLDPWD/src/ensembles/images.f90" deals.f90 -o deals &&
            mpirun -n $n "${options[@]}" ./deals 2>/dev/null)
    done
    awk -v a="$a" -v b="$b" -v c="$c" 'BEGIN {
        printf "flip_map, half: %.2f s by one process; whole: %.2f s, and %.2f s by two images\n", a, b, c
        printf "%.0f us a trajectory, %.1f ms a block of 64\n", b/160000*1e6, b/160000*64*1e3
        printf "strong scaling: efficiency %.3f; weak: %.3f\n", b/(2*c), a/c }'
    exit 0
fi

while read -r name words; do
    for n in 0 2 3; do
        on $n images_$n $name --set scene%output=$name $words || check "sweep $name on $n images: status $?" false
    done
    check "sweep $name: one process, two images and three" same "${name}_sweep.dat" images_0 \
        images_2 images_3
done <<'SWEEPS'
flip_map --over theta1=0.5:3:20 --over theta2=-3:3:20
bifurcation --over f=1:1.5:9 --set scene%duration=600
basins --over theta=-3:3:9 --over theta_dot=-8:8:5
double_pendulum --set scene%method='dop853' --set scene%tolerance=1e-9 --set scene%samples=1 --over theta1=0:1:300 --keep theta2
SWEEPS

map=(flip_map --set scene%output=flip_map --over theta1=-pi:pi:200 --over theta2=-pi:pi:200)
on 0 whole "${map[@]}"
on 2 killed "${map[@]}" &
running=$!
victim= # a bare Debian has no pgrep; on a busy machine the sweep must not end while we look for it
for _ in $(seq 600); do
    [ -n "$victim" ] || victim=$(grep -la "^$images" /proc/[0-9]*/cmdline 2>/dev/null | xargs -r grep -la "$work/killed" 2>/dev/null | head -n 1)
    [ -n "$victim" ] && [ -n "$(find "$work/killed" -name '*.part*' -size +4k 2>/dev/null)" ] && break
    sleep 0.05
done
victim=${victim#/proc/}
[ -n "$victim" ] && kill -9 "${victim%/cmdline}"
wait $running
status=$?
check "an image that is killed ends the sweep with status $status" [ $status -ne 0 ]
check "what is complete stays" eval '[ -n "$(find "$work/killed" -name "*.part*")" ] && [ ! -e "$work/killed/flip_map_sweep.dat" ]'
on 3 killed "${map[@]}" --resume
check "three images go on to the same bytes" same flip_map_sweep.dat whole killed
check "and take the parts away" eval '[ -z "$(find "$work/killed" -name "*.part*")" ]'

lines=""
for _ in 1 2 3 4 5 6; do
    on 2 bad flip_map --over nothing=0:1:3
    lines+="$? $(grep -ac "^lagrangia: " "$work/err") "
done
check "bad input: status 2 and one line of ours, every time: $lines" [ "$lines" = "2 1 2 1 2 1 2 1 2 1 2 1 " ]
exit $((failed > 0))
