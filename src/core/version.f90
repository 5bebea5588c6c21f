module lagrangia_version
    !! What was built, and how.
    use, intrinsic :: iso_fortran_env, only: compiler_options, compiler_version
    implicit none (type, external)
    private
    public :: version, build_text, is_optimised

    character(*), parameter :: version = "0.1.0"

contains

    pure function build_text(brief) result(text)
        !! Compiler and flags; folders of the build machine are left out, and so are, if `brief`,
        !! the many flags that `-march=native` stands for.
        logical, intent(in), optional :: brief  !! false unless given
        character(:), allocatable :: text

        text = compiler_version()//", "//flags(brief)// &
               merge(", optimised    ", ", not optimised", is_optimised())
        text = trim(text)
    end function build_text

    pure function is_optimised() result(yes)
        !! Whether this build is one to measure with.
        logical :: yes
        character(:), allocatable :: options

        options = " "//compiler_options()
        yes = index(options, " -O2") + index(options, " -O3") > 0
    end function is_optimised

    pure function flags(brief) result(text)
        !! The options that change results or speed: `-O`, `-f`, `-m`, `-g`, `-std`.
        logical, intent(in), optional :: brief
        character(:), allocatable :: text
        logical :: short
        character(:), allocatable :: all, word
        integer :: first, last

        short = .false.
        if (present(brief)) short = brief
        all = compiler_options()//" "
        text = ""
        first = 1
        do while (first <= len(all))
            last = index(all(first:), " ") + first - 2
            word = all(first:last)
            first = last + 2
            if (len(word) < 2 .or. index(word, "/") > 0) cycle
            if (short .and. index(word, "-m") == 1 .and. index(word, "=") == 0) cycle
            if (index("Ofmgs", word(2:2)) > 0 .and. word(1:1) == "-") text = text//" "//word
        end do
        text = text(2:)
    end function flags
end module lagrangia_version
