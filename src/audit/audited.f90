module lagrangia_audited
    !! Systems by their names with parameters from the words behind `--set`, without a scene.
    use lagrangia_catalogue, only: new_system
    use lagrangia_command_line, only: word_t
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_namelist, only: apply_override, get_reals, has_key, namelist_t, &
                                  parse_namelist, refuse_unknown_groups, refuse_unknown_keys, &
                                  refuse_value
    use lagrangia_system, only: check_parameter, default_values, system_t
    implicit none (type, external)
    private
    public :: audited_t, read_audited

    type :: audited_t
        !! A system, and which of its parameters were given.
        class(system_t), allocatable :: system
        logical, allocatable :: fixed(:)
        real(dp), allocatable :: given(:)  !! all values, defaults where none was given
    end type audited_t

contains

    subroutine read_audited(names, words, audited, error)
        !! Fails on unknown systems, on groups and keys that are not theirs, and on values that
        !! are not allowed.
        character(*), intent(in) :: names(:)
        type(word_t), intent(in) :: words(:)  !! `GROUP%KEY=VALUE`
        type(audited_t), allocatable, intent(out) :: audited(:)
        type(error_t), allocatable, intent(out) :: error
        type(namelist_t) :: tree
        integer :: i

        allocate (audited(size(names)))
        do i = 1, size(names)
            call new_system(trim(names(i)), audited(i)%system, error)
            if (allocated(error)) return
        end do
        if (size(names) == 0) return
        call parse_namelist("&"//trim(names(1))//" /", "check", tree, error)
        if (allocated(error)) return
        do i = 1, size(words)
            call apply_override(tree, words(i)%text, error)
            if (allocated(error)) return
        end do
        do i = 1, size(names)
            call read_parameters(tree, audited(i), error)
            if (allocated(error)) return
        end do
        call refuse_unknown_groups(tree, names, error)
    end subroutine read_audited

    subroutine read_parameters(tree, audited, error)
        !! Those of one system.
        type(namelist_t), intent(inout) :: tree
        type(audited_t), intent(inout) :: audited
        type(error_t), allocatable, intent(out) :: error
        type(description_t) :: d
        type(error_t), allocatable :: refusal
        character(name_length), allocatable :: keys(:)
        real(dp), allocatable :: values(:)
        logical :: found
        integer :: i, first

        call audited%system%describe(d)
        allocate (audited%given, source=default_values(d))
        allocate (audited%fixed(size(audited%given)))
        audited%fixed = .false.
        first = 1
        do i = 1, size(d%parameters)
            associate (p => d%parameters(i), last => first + d%parameters(i)%count - 1)
                allocate (values, source=p%value(:p%count))
                call get_reals(tree, trim(d%name), trim(p%name), p%count, p%count, values, error)
                found = has_key(tree, trim(d%name), trim(p%name))
                if (allocated(error)) return
                audited%given(first:last) = values
                audited%fixed(first:last) = found
                p%value(:p%count) = values
                call check_parameter(p, refusal)
                if (found .and. allocated(refusal)) then
                    call refuse_value(tree, trim(d%name), trim(p%name), &
                                      p%domain()//" is needed", error)
                    return
                end if
            end associate
            deallocate (values)
            first = first + d%parameters(i)%count
        end do
        allocate (keys(size(d%parameters)))
        keys = d%parameters%name
        call refuse_unknown_keys(tree, trim(d%name), keys, error)
    end subroutine read_parameters
end module lagrangia_audited
