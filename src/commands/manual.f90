module lagrangia_manual
    !! `lagrangia manual`: a page for `man`, made of the tables that `--help` prints.
    use lagrangia_command_line, only: word_t
    use lagrangia_command_pages, only: pages
    use lagrangia_help, only: exit_status_text, value_words
    use lagrangia_registry, only: accepts, commands, options, usage
    use lagrangia_scene_reference, only: reference_lines
    use lagrangia_version, only: version
    use lagrangia_wrapping, only: wrapped
    implicit none (type, external)
    private
    public :: manual_text

    character(*), parameter :: lf = new_line("a")
    character(*), parameter :: date = "2026-11-22"  !! of the last change of what it says
    character(*), parameter :: slash = achar(92)    !! begins what means something to roff

contains

    function manual_text() result(text)
        !! The page, in roff with the macros of man.
        character(:), allocatable :: text, kinds
        type(word_t), allocatable :: lines(:)
        integer :: i, k, page

        text = ""
        call add(".TH LAGRANGIA 1 """//date//""" ""lagrangia "//version//""" ""User Commands""")
        call add(".SH NAME")
        call say("lagrangia - the systems of a classical-mechanics course, run and checked")
        call add(".SH SYNOPSIS")
        call add(".B lagrangia")
        call say("[command] [options]")
        call add(".SH DESCRIPTION")
        call say("Without a command it runs every scene of the folder data/scenes, or of those "// &
                 "that come with the program where there is no such folder, and prints how far "// &
                 "each is from what is known exactly.")
        call add(".SH COMMANDS")
        do i = 2, size(commands)
            call add(".SS "//plain(trim(commands(i)%name)//" "//commands(i)%arguments))
            page = findloc(pages%name == commands(i)%name, .true., 1)
            call say(trim(pages(page)%purpose))
            kinds = ""
            do k = 1, size(options)
                if (accepts(commands(i), options(k)%name)) kinds = kinds//", --"// &
                    trim(options(k)%name)
            end do
            if (kinds /= "") then
                call add(".PP")
                call say("Options: "//kinds(3:)//".")
            end if
            call add(".PP")
            call add(".EX")
            do k = 1, size(pages(page)%examples)
                if (pages(page)%examples(k) == "") cycle
                call add(plain(trim(pages(page)%examples(k))))
            end do
            call add(".EE")
        end do
        call add(".SH OPTIONS")
        do k = 1, size(options)
            call add(".TP")
            call add(".B "//plain(usage(options(k))))
            call say(trim(options(k)%meaning))
        end do
        call add(".SH SYSTEMS")
        call say(value_words("systems", ", "))
        call add(".SH SCENES")
        call say(value_words("scenes", ", "))
        call add(".SH SCENE FILES")
        call add(".EX")
        call reference_lines(lines)
        do k = 1, size(lines)
            call add(plain(lines(k)%text))
        end do
        call add(".EE")
        call add(".SH EXIT STATUS")
        call say(exit_status_text)
        call add(".SH FILES")
        call add(".TP")
        call add(".I "//plain("data/output"))
        call say("data files, gnuplot scripts and pictures, unless --output names another folder")
        call add(".TP")
        call add(".I "//plain("data/scenes"))
        call say("scenes of the working folder, found by their names before those that come "// &
                 "with the program")
        call add(".SH ENVIRONMENT")
        call say("Nothing is printed in colour, whatever NO_COLOR is.")
    contains
        subroutine add(line)
            character(*), intent(in) :: line

            text = text//trim(line)//lf
        end subroutine add

        subroutine say(line)
            !! A paragraph, in lines short enough for roff's marks besides.
            character(*), intent(in) :: line
            type(word_t), allocatable :: folded(:)
            integer :: n

            call wrapped(line, 60, folded)
            do n = 1, size(folded)
                call add(plain(folded(n)%text))
            end do
        end subroutine say
    end function manual_text

    pure function plain(text) result(roff)
        !! Text of which roff takes nothing for its own.
        character(*), intent(in) :: text
        character(:), allocatable :: roff
        integer :: i

        roff = ""
        if (scan(text//" ", ".'") == 1) roff = slash//"&"
        do i = 1, len(text)
            select case (text(i:i))
            case (slash); roff = roff//slash//"e"
            case ("-"); roff = roff//slash//"-"
            case ("'"); roff = roff//slash//"(aq"
            case ("^"); roff = roff//slash//"(ha"
            case ("~"); roff = roff//slash//"(ti"
            case ("`"); roff = roff//slash//"(ga"
            case default; roff = roff//text(i:i)
            end select
        end do
    end function plain
end module lagrangia_manual
