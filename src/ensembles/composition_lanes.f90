module lagrangia_composition_lanes
    !! Steps of splitting methods, one trajectory a lane: the drifts and kicks of
    !! `lagrangia_composition` in the same order, so that only sine and cosine may differ.
    use lagrangia_composition_table, only: find_row, round_row, row_t
    use lagrangia_fixed_lanes, only: fixed_lanes_t
    use lagrangia_kinds, only: dp, lanes
    use lagrangia_scene, only: scene_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: composition_lanes_t, new_composition_lanes

    type, extends(fixed_lanes_t) :: composition_lanes_t
        private
        logical :: kick_first = .false.
        real(dp), allocatable :: drift(:), kick(:)  !! fractions of the step
        real(dp), allocatable :: node(:)            !! of the evaluations, fractions of the step
        real(dp), allocatable :: a(:, :)            !! accelerations, (lanes, ndof)
    contains
        procedure :: prepare
        procedure :: begin
        procedure :: advance
    end type composition_lanes_t

contains

    pure subroutine new_composition_lanes(self, name)
        !! The method of this name.
        type(composition_lanes_t), intent(out) :: self  !! not yet prepared
        character(*), intent(in) :: name                !! one of the table
        type(row_t) :: row

        call find_row(name, row)
        self%kick_first = row%kick_first
        call round_row(row, self%drift, self%kick, self%node)
    end subroutine new_composition_lanes

    pure subroutine prepare(self, system)
        !! See `lane_method_t`.
        class(composition_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp) :: state(lanes, system%ndof)

        call self%prepare_states(system)
        state = 0.0_dp
        self%a = state
    end subroutine prepare

    pure subroutine begin(self, system, lane, scene)
        !! See `lane_method_t`. The first kick needs the accelerations.
        class(composition_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(in) :: lane
        type(scene_t), intent(in) :: scene
        real(dp) :: a(system%ndof)

        call self%begin_steps(system, lane, scene)
        if (.not. self%kick_first) return
        call system%accelerations(scene%t0, scene%q, scene%v, a)
        self%a(lane, :) = a
    end subroutine begin

    pure subroutine advance(self, system, h, t_end)
        !! See `fixed_lanes_t`.
        class(composition_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: h(lanes), t_end(lanes)

        if (self%kick_first) then
            call take_velocity_step(self, system, system%ndof, h, t_end, self%y)
        else
            call take_position_step(self, system, system%ndof, h, self%y)
        end if
    end subroutine advance

    pure subroutine take_position_step(self, system, n, h, y)
        !! Drift, kick, ..., drift.
        class(composition_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(in) :: n
        real(dp), intent(in) :: h(lanes)
        real(dp), intent(inout) :: y(lanes, n, 2)
        integer :: s

        associate (q => y(:, :, 1), v => y(:, :, 2))
            do s = 1, size(self%kick)
                call add(n, self%drift(s), h, v, q)
                call system%accelerations_lanes(self%t + self%node(s)*h, q, v, self%a)
                call add(n, self%kick(s), h, self%a, v)
            end do
            call add(n, self%drift(size(self%drift)), h, v, q)
        end associate
    end subroutine take_position_step

    pure subroutine take_velocity_step(self, system, n, h, t_end, y)
        !! Kick, drift, kick: the accelerations at its end are the first of the next one.
        class(composition_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(in) :: n
        real(dp), intent(in) :: h(lanes), t_end(lanes)
        real(dp), intent(inout) :: y(lanes, n, 2)

        associate (q => y(:, :, 1), v => y(:, :, 2))
            call add(n, self%kick(1), h, self%a, v)
            call add(n, self%drift(1), h, v, q)
            call system%accelerations_lanes(t_end, q, v, self%a)
            call add(n, self%kick(2), h, self%a, v)
        end associate
    end subroutine take_velocity_step

    pure subroutine add(n, part, h, slope, y)
        !! Go along a slope for a part of the steps.
        integer, intent(in) :: n
        real(dp), intent(in) :: part, h(lanes), slope(lanes, n)
        real(dp), intent(inout) :: y(lanes, n)
        integer :: i

        do i = 1, n
            y(:, i) = y(:, i) + part*h*slope(:, i)
        end do
    end subroutine add
end module lagrangia_composition_lanes
