module lagrangia_system_validation
    !! What a system from outside must bring along before it may join the catalogue.
    use lagrangia_columns, only: column_names
    use lagrangia_counted, only: counted
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t, fail
    use lagrangia_motion_check, only: check_motions
    use lagrangia_system, only: default_values, system_t
    use lagrangia_text, only: lower, quoted, to_text
    implicit none (type, external)
    private
    public :: validate_system

    character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyz"
    character(*), parameter :: capitals = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
    character(*), parameter :: others = "0123456789_"
    character(*), parameter :: reserved(2) = ["scene  ", "methods"]  !! other groups, other tables

contains

    subroutine validate_system(system, taken, error)
        !! Fails on a name that is `taken` or cannot be typed, on a description with gaps, on
        !! defaults that are not allowed, and on a closed form or a reduced system of another
        !! motion. `system` has its default parameters on return.
        class(system_t), intent(inout) :: system  !! gets its default parameters
        character(*), intent(in) :: taken(:)  !! names of the systems that are there
        type(error_t), allocatable, intent(out) :: error  !! what is wrong, and of which system
        type(description_t) :: d

        check: block
            call system%describe(d)
            call check_name(d%name, letters, error)
            if (allocated(error)) exit check
            if (any(reserved == d%name)) then
                call fail(error, "the name is reserved: give yours another one")
            else if (any(taken == d%name)) then
                call fail(error, "there is a system of that name: give yours another one")
            end if
            if (allocated(error)) exit check
            call check_completeness(d, error)
            if (allocated(error)) exit check
            call system%configure(default_values(d), error)
            if (allocated(error)) exit check
            call system%describe(d)
            if (system%ndof /= size(d%coordinates)) then
                call fail(error, "ndof = "//to_text(system%ndof)//", but it describes "// &
                          counted(size(d%coordinates), "coordinate"))
                exit check
            end if
            call check_names(system, d, error)
            if (allocated(error)) exit check
            call check_motions(system, error)
        end block check
        if (allocated(error)) call error%add_context("system "//quoted(trim(d%name)))
    end subroutine validate_system

    pure subroutine check_name(name, first, error)
        !! Something that a scene can name: one of `first`, then letters, digits and underscores.
        character(*), intent(in) :: name, first
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: what

        what = "small letters"
        if (len(first) > len(letters)) what = "letters"
        if (verify(trim(name), first//others) == 0 .and. scan(name(1:1), first) == 1) then
            if (len_trim(name) < len(name)) return
            call fail(error, "the name is too long, or was cut off: at most "// &
                      to_text(len(name) - 1)//" characters")
        else
            call fail(error, quoted(trim(name))//" is no name: "//what//", digits and _ make "// &
                      "one, a letter first")
        end if
    end subroutine check_name

    pure subroutine check_completeness(d, error)
        !! Every list is there, though it may be empty; coordinates are not.
        type(description_t), intent(in) :: d
        type(error_t), allocatable, intent(out) :: error

        character(:), allocatable :: missing
        logical :: none

        none = .not. allocated(d%coordinates)
        if (.not. none) none = size(d%coordinates) == 0
        missing = ""
        if (.not. allocated(d%notes)) missing = "notes"
        if (.not. allocated(d%equations)) missing = "equations"
        if (.not. allocated(d%points)) missing = "points"
        if (.not. allocated(d%quantities)) missing = "quantities"
        if (.not. allocated(d%parameters)) missing = "parameters"
        if (none) then
            call fail(error, "its description has no coordinates")
        else if (missing /= "") then
            call fail(error, "its description leaves out '"//missing//"': allocate it, empty "// &
                      "if there are none")
        end if
    end subroutine check_completeness

    pure subroutine check_names(system, d, error)
        !! Capitals are allowed. Parameters are keys, which differ by more than capitals.
        class(system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        type(error_t), allocatable, intent(out) :: error
        character(name_length), allocatable :: columns(:)
        character(name_length) :: keys(size(d%parameters))
        integer :: i

        do i = 1, size(d%parameters)
            call check_name(d%parameters(i)%name, letters//capitals, error)
            if (allocated(error)) return
            keys(i) = lower(d%parameters(i)%name)
            if (all(keys(:i - 1) /= keys(i))) cycle
            call fail(error, "two parameters are called "//quoted(trim(d%parameters(i)%name)))
            return
        end do
        allocate (columns, source=column_names(system, .true.))
        do i = 1, size(columns)
            call check_name(columns(i), letters//capitals, error)
            if (allocated(error)) return
            if (all(columns(:i - 1) /= columns(i))) cycle
            call fail(error, "two columns are called "//quoted(trim(columns(i))))
            return
        end do
    end subroutine check_names
end module lagrangia_system_validation
