module lagrangia_gnuplot_script
    !! What every gnuplot script of ours begins with: it finds its data beside itself, wherever it
    !! is run from, and takes the best terminal that there is. And how a text gets into a script.
    use lagrangia_characters, only: printable
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: lines_t, begin_script, gnuplot_string

    type :: lines_t
        character(:), allocatable :: text
    contains
        procedure :: add
    end type lines_t

contains

    pure subroutine begin_script(script, file, width, height, rows, drawn)
        !! The first lines of the script for `file`, a bare name beside it: `folder` is where it is,
        !! `kind` the terminal, and the picture is `NAME.png`, .svg or .pdf; with two arguments
        !! (`gnuplot -c NAME.gp KIND PICTURE`) it is of the kind, and has the name, that they say.
        !!
        !! Text is enhanced: a string that is not made for that is followed by `noenhanced`.
        type(lines_t), intent(out) :: script  !! its first lines
        character(*), intent(in) :: file  !! the data file's name
        integer, intent(in) :: width, height  !! pixels
        integer, intent(in) :: rows           !! lines of text, where there are no pixels
        character(*), intent(in), optional :: drawn  !! several data files, where there is no `file`
        character(:), allocatable :: pixels
        integer :: dot

        dot = index(file, ".", back=.true.)
        pixels = to_text(width)//","//to_text(height)
        script%text = ""
        if (present(drawn)) then
            call script%add("# Draws "//printable(drawn)//" as they lie beside this script.")
        else
            call script%add("# Draws "//printable(file)//" as it lies beside this script.")
        end if
        call script%add("set encoding iso_8859_1  # a folder's name is taken apart by bytes")
        call script%add("folder = './'")
        call script%add("if (exists('ARG0')) { do for [i=1:strlen(ARG0)] { "// &
                        "if (ARG0[i:i] eq '/') { folder = ARG0[1:i] } } }")
        call script%add("if (folder[1:1] ne '/') { folder = './'.folder }")
        call script%add("set encoding utf8  # without a locale gnuplot warns of a degree sign: "// &
                        "export LANG=C.UTF-8")
        call script%add("picture = folder."//gnuplot_string(file(:dot - 1)))
        call script%add("if (!exists('wanted')) { wanted = 'png' }")
        call script%add("png = picture.'.png'; svg = picture.'.svg'; pdf = picture.'.pdf'")
        call script%add("if (exists('ARGC') && ARGC == 2) { "// &
                        "wanted = ARG1; png = ARG2; svg = ARG2; pdf = ARG2 }")
        call script%add("can(name) = strstrt(GPVAL_TERMINALS, ' '.name.' ')")
        call script%add("kind = wanted eq 'svg' && can('svg') ? 'svg' : "// &
                        "wanted eq 'pdf' && can('pdfcairo') ? 'pdfcairo' : "// &
                        "can('pngcairo') ? 'pngcairo' : can('png') ? 'png' : "// &
                        "can('svg') ? 'svg' : 'dumb'")
        call script%add("if (kind eq 'pngcairo') { set terminal pngcairo enhanced size "// &
                        pixels//" font ',14'; set output png }")
        call script%add("if (kind eq 'png') { set terminal png enhanced size "//pixels// &
                        " medium; set output png }")
        call script%add("if (kind eq 'svg') { set terminal svg enhanced size "//pixels// &
                        " font ',14' fontscale 1.33 background 'white'; set output svg }")
        call script%add("if (kind eq 'pdfcairo') { set terminal pdfcairo enhanced size "// &
                        inches(width)//","//inches(height)//" font ',14' fontscale 0.75 "// &
                        "linewidth 1.5; set output pdf }")
        call script%add("if (kind eq 'dumb') { set terminal dumb enhanced size 100,"// &
                        to_text(rows)//" }")
    end subroutine begin_script

    pure function inches(pixels) result(text)
        !! A hundred pixels are an inch.
        integer, intent(in) :: pixels
        character(:), allocatable :: text

        text = to_text(pixels/100)//"."//to_text(modulo(pixels/10, 10))// &
               to_text(modulo(pixels, 10))//"in"
    end function inches

    pure function gnuplot_string(text) result(string)
        !! `text` as a string of gnuplot, quotes included: the only way for a text into a script.
        !!
        !! Between double quotes gnuplot knows \ and ", runs what stands between backquotes, and has
        !! replaced macros behind @; so these four are escaped. (Between single quotes a doubled one
        !! right behind the first ends the string.) What is not printable is escaped twice, and
        !! so shown as `\xNN`. Source: gnuplot 5.4, "Quote Marks", "Substitution".
        character(*), intent(in) :: text  !! trailing blanks count
        character(:), allocatable :: string
        character(:), allocatable :: plain
        integer :: i

        plain = printable(text)
        string = """"
        do i = 1, len(plain)
            select case (plain(i:i))
            case ("""", "\")
                string = string//"\"//plain(i:i)
            case ("`")
                string = string//"\140"
            case ("@")
                string = string//"\100"
            case default
                string = string//plain(i:i)
            end select
        end do
        string = string//""""
    end function gnuplot_string

    pure subroutine add(self, line)
        !! One more line.
        class(lines_t), intent(inout) :: self
        character(*), intent(in) :: line  !! without its end

        self%text = self%text//line//new_line("a")
    end subroutine add
end module lagrangia_gnuplot_script
