module lagrangia_version
    !! What was built, and how.
    use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char
    use, intrinsic :: iso_fortran_env, only: compiler_options, compiler_version
    implicit none (type, external)
    private
    public :: version, build_text, is_optimised

    character(*), parameter :: version = "0.2.0"

    interface
        pure function c_vector_unit(i) result(letter) bind(c, name="lagrangia_vector_unit")
            !! In `processor.c`, which refuses to start where the processor has no such unit.
            import :: c_char, c_int
            implicit none (type, external)
            integer(c_int), intent(in), value :: i  !! from 1
            character(kind=c_char) :: letter        !! of the name; null behind it
        end function c_vector_unit
    end interface

contains

    pure function build_text() result(text)
        !! Compiler, flags and the vector unit they are for. Folders of the build machine are left
        !! out, and so are the many flags that `-march=native` stands for.
        character(:), allocatable :: text

        text = compiler_version()//", "//flags()//", "//vector_unit()// &
               merge(", optimised    ", ", not optimised", is_optimised())
        text = trim(text)
    end function build_text

    pure function vector_unit() result(name)
        !! The vector instructions that all sources were compiled for: `AVX-512`, `AVX2`, `SSE2`.
        character(:), allocatable :: name
        integer :: i

        name = ""
        do i = 1, 16
            if (c_vector_unit(i) == c_null_char) return
            name = name//c_vector_unit(i)
        end do
    end function vector_unit

    pure function is_optimised() result(yes)
        !! Whether this build is one to measure with.
        logical :: yes
        character(:), allocatable :: options

        options = " "//compiler_options()
        yes = index(options, " -O2") + index(options, " -O3") > 0
    end function is_optimised

    pure function flags() result(text)
        !! The options that change results or speed: `-O`, `-f`, `-m...=`, `-g`, `-std`.
        character(:), allocatable :: text
        character(:), allocatable :: all, word
        integer :: first, last

        all = compiler_options()//" "
        text = ""
        first = 1
        do while (first <= len(all))
            last = index(all(first:), " ") + first - 2
            word = all(first:last)
            first = last + 2
            if (len(word) < 2 .or. index(word, "/") > 0) cycle
            if (index(word, "-m") == 1 .and. index(word, "=") == 0) cycle
            if (index("Ofmgs", word(2:2)) > 0 .and. word(1:1) == "-") text = text//" "//word
        end do
        text = text(2:)
    end function flags
end module lagrangia_version
