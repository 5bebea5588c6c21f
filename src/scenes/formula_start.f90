module lagrangia_formula_start
    !! Whether the formulas of a scene make sense at its start, and what is to blame where not.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: euler_lagrange_t, expand_lagrangian
    use lagrangia_lagrangian_group, only: group
    use lagrangia_mass_matrix, only: check_mass_matrix, list_of
    use lagrangia_namelist, only: has_key, namelist_t, refuse_value
    use lagrangia_random_draws, only: random_t
    use lagrangia_scene, only: scene_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use lagrangia_typical_sizes, only: find_typical_sizes
    use lagrangia_written_system, only: written_system_t
    implicit none (type, external)
    private
    public :: check_formulas_at_start

contains

    subroutine check_formulas_at_start(tree, system, scene, error)
        !! Fails where T, V, L or a derivative is no finite number at the start, or the mass matrix
        !! is singular there. Else the system learns the typical sizes of its motion.
        type(namelist_t), intent(inout) :: tree            !! says where the formulas are
        class(system_t), intent(inout) :: system           !! of any kind, with its parameters
        type(scene_t), intent(in) :: scene                 !! has its start
        type(error_t), allocatable, intent(out) :: error   !! status 2, at the formula or at q
        type(euler_lagrange_t) :: terms
        type(error_t), allocatable :: cause
        character(:), allocatable :: state
        real(dp), allocatable :: places(:)
        real(dp) :: time

        select type (system)
        class is (written_system_t)
            state = "at t = "//to_text(scene%t0)//", q = "//list_of(scene%q)//", v = "// &
                    list_of(scene%v)
            call refuse_infinite(tree, system, scene, state, error)
            if (allocated(error)) return
            call expand_lagrangian(system, scene%t0, scene%q, scene%v, terms)
            call check_mass_matrix(terms%mass, cause)
            if (.not. allocated(cause)) then
                call find_typical_sizes(system, scene%t0, scene%q, scene%v, places, time)
                system%stated%typical_time = time
                call move_alloc(places, system%stated%typical_places)
                return
            end if
            if (is_singular_everywhere(system)) then
                call refuse_value(tree, group, key_of("t", "l"), cause%message//", "//state// &
                                  " and elsewhere: a combination of velocities has no "// &
                                  "inertia, or a negative one", error)
            else
                call refuse_value(tree, "scene", "q", cause%message//", "//state// &
                                  "; start elsewhere, or take other coordinates", error)
            end if
        end select
    contains
        function key_of(with_t, with_l) result(key)
            !! Which formula there is.
            character(*), intent(in) :: with_t, with_l
            character(1) :: key

            key = with_l
            if (has_key(tree, group, with_t)) key = with_t
        end function key_of
    end subroutine check_formulas_at_start

    subroutine refuse_infinite(tree, system, scene, state, error)
        !! Name the formula, T, V or L, that has no finite value, or a derivative that is none.
        type(namelist_t), intent(inout) :: tree
        type(written_system_t), intent(in) :: system
        type(scene_t), intent(in) :: scene
        character(*), intent(in) :: state
        type(error_t), allocatable, intent(out) :: error
        character(1), parameter :: keys(3) = ["t", "v", "l"]
        character(*), parameter :: reasons = ": a division by zero, an overflow, or a root or "// &
                                             "logarithm of such a number; start elsewhere"
        type(formula_program_t) :: program
        type(expression_t) :: formulas(3)
        type(hyperdual_t) :: values(size(system%expressions%symbols%names)), results(3)
        integer :: i, k

        associate (e => system%expressions)
            formulas(1) = e%kinetic
            formulas(2) = e%potential
            formulas(3) = e%lagrangian
        end associate
        call new_formula_program(program, formulas, size(values))
        values%re = [scene%t0, scene%q, scene%v, system%p]
        do k = 0, 1 + 2*system%ndof  ! the values, then the derivatives by symbol k
            values%d1 = merge(1.0_dp, 0.0_dp, [(i == k, i=1, size(values))])
            values%d2 = values%d1
            call program%evaluate(values, results)
            do i = 1, size(keys)
                if (k == 0) then  ! 0 times an infinite derivative is NaN
                    if (ieee_is_finite(results(i)%re)) cycle
                else
                    if (.not. formulas(i)%depends_on(k)) cycle
                    if (ieee_is_finite(results(i)%d1 + results(i)%d12)) cycle
                end if
                if (.not. has_key(tree, group, keys(i))) cycle
                if (k == 0) then
                    call refuse_value(tree, group, keys(i), "is no finite number "//state// &
                                      reasons, error)
                else
                    call refuse_value(tree, group, keys(i), "has no finite derivatives by "// &
                                      trim(system%expressions%symbols%names(k))//" "//state// &
                                      "; start elsewhere", error)
                end if
                return
            end do
        end do
    end subroutine refuse_infinite

    function is_singular_everywhere(system) result(yes)
        !! At random states, too.
        type(written_system_t), intent(in) :: system
        logical :: yes
        type(random_t) :: random
        type(euler_lagrange_t) :: terms
        type(error_t), allocatable :: cause, none_drawn
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t
        integer :: i

        yes = .false.
        do i = 1, 4
            call random%state(system, t, q, v, none_drawn)
            if (allocated(none_drawn)) return
            call expand_lagrangian(system, t, q, v, terms)
            call check_mass_matrix(terms%mass, cause)
            if (.not. allocated(cause)) return
        end do
        yes = .true.
    end function is_singular_everywhere
end module lagrangia_formula_start
