module lagrangia_errata_formulas
    !! Both sides of a slip, read as formulas and compared with the code at a random state: what
    !! stands in the notes is false, what is derived is true.
    use lagrangia_catalogue, only: new_system
    use lagrangia_description, only: description_t, name_length, value_names
    use lagrangia_errata_ledger, only: slip_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_named_values, only: motion_state_t
    use lagrangia_random_draws, only: random_t
    use lagrangia_report, only: report_t
    use lagrangia_statements, only: statements_t
    use lagrangia_system, only: system_t
    use lagrangia_term_sizes, only: neighbours, term_size
    implicit none (type, external)
    private
    public :: add_both_sides

    real(dp), parameter :: rounding = 1e-12_dp
    !! of the terms: some ten operations, and accelerations from a mass matrix of condition 100

contains

    subroutine add_both_sides(slip, report, error)
        !! Two rows, if the slip has formulas in the letters of a system.
        type(slip_t), intent(in) :: slip                  !! of the ledger
        type(report_t), intent(inout) :: report           !! gets the rows
        type(error_t), allocatable, intent(out) :: error  !! a formula cannot be read
        real(dp) :: left(2), right(2), size_of(2)

        if (slip%system == "") return
        call sides_at_random(slip, left, right, size_of, error)
        if (allocated(error)) return
        call report%section(trim(slip%system)//", parameters and state at random: "// &
                            "left and right side")
        call report%equal("as it reads, is it so?", left(1), right(1), rounding*size_of(1), &
                          control=.true.)
        call report%equal("as derived, it is", left(2), right(2), rounding*size_of(2))
    end subroutine add_both_sides

    subroutine sides_at_random(slip, left, right, size_of, error)
        !! Of what it reads, and of what is derived.
        type(slip_t), intent(in) :: slip                          !! with the name of a system
        real(dp), intent(out) :: left(2), right(2), size_of(2)    !! the sides, and their sizes
        type(error_t), allocatable, intent(out) :: error          !! a formula cannot be read
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(statements_t) :: statements
        type(motion_state_t) :: state
        type(random_t) :: random
        real(dp), allocatable :: values(:)
        real(dp), dimension(2, 0:neighbours) :: lefts, rights
        character(name_length), allocatable :: names(:)
        integer :: i

        left = 0.0_dp
        right = 0.0_dp
        size_of = 0.0_dp
        call new_system(trim(slip%system), system, error)
        if (allocated(error)) return
        call random%parameters(system, .false., values, error)
        if (allocated(error)) return
        call system%describe(d)
        allocate (names, source=value_names(d))
        do i = 1, size(names)
            if (index(" "//slip%without//" ", " "//trim(names(i))//" ") > 0) values(i) = 0.0_dp
        end do
        call system%configure(values, error)
        if (allocated(error)) return
        call system%describe(d)
        call random%state(system, state%t, state%q, state%v, error)
        if (allocated(error)) return
        allocate (state%a(size(state%q)))
        allocate (state%q0, source=state%q)
        allocate (state%v0, source=state%v)
        call system%accelerations(state%t, state%q, state%v, state%a)
        call statements%begin(system, d, state, error)
        if (.not. allocated(error)) call statements%add_equation(trim(slip%wrong), error)
        if (.not. allocated(error)) call statements%add_equation(trim(slip%right), error)
        if (allocated(error)) return
        call statements%finish()
        call statements%evaluate(system, d, state, left, right)
        lefts(:, 0) = left
        rights(:, 0) = right
        do i = 1, neighbours
            call statements%evaluate(system, d, state, lefts(:, i), rights(:, i), random)
        end do
        size_of = [(term_size(lefts(i, :)) + term_size(rights(i, :)), i=1, 2)]
    end subroutine sides_at_random
end module lagrangia_errata_formulas
