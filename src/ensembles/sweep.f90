module lagrangia_sweep
    !! Many trajectories of one scene: a number or two of it are changed over a grid, and of each
    !! trajectory a few numbers are kept.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
    use lagrangia_attractor, only: signature_size
    use lagrangia_columns, only: columns_t
    use lagrangia_composition_table, only: find_row, row_t
    use lagrangia_description, only: default_values, description_t, name_length, velocity_names
    use lagrangia_errors, only: error_t, fail, status_numbers
    use lagrangia_events, only: column_event_t, new_column_event
    use lagrangia_kept, only: is_exact_extreme, is_lyapunov, keeps_attractor, keeps_end, &
                              keeps_flip, keeps_largest, keeps_smallest, keeps_wrapped, kept_t, &
                              read_kept
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: auto, workhorse
    use lagrangia_names, only: advice
    use lagrangia_random_draws, only: random_t
    use lagrangia_scene, only: most_axes, scene_t, sweep_text_length
    use lagrangia_strobe, only: new_strobe, strobe_t
    use lagrangia_sweep_axis, only: new_sweep_axis, sweep_axis_t
    use lagrangia_sweep_events, only: choose_events
    use lagrangia_system, only: reduced_t, system_t
    use lagrangia_text, only: join, quoted, to_text
    use lagrangia_variational, only: new_variational, variational_t
    use lagrangia_velocity_of_energy, only: find_velocity, is_lost
    implicit none (type, external)
    private
    public :: sweep_t, sweep_box_t
    public :: exponent_method, fits_lanes, follows_displacements, new_sweep

    integer(i8), parameter :: most_trajectories = 10_i8**18  !! numbers of them are counters

    type :: sweep_t
        !! A grid of trajectories. The first axis is the one that varies slowest.
        type(scene_t) :: scene                   !! what all have in common
        class(system_t), allocatable :: system   !! with the scene's parameters
        type(sweep_axis_t), allocatable :: axes(:)
        type(kept_t), allocatable :: kept(:)
        type(columns_t) :: columns               !! those that `kept` takes
        integer :: events = 0                    !! number of events that `kept` takes
        logical :: stops = .false.               !! an event of the scene's own may end a trajectory
        real(dp) :: after = 0.0_dp               !! samples before this time don't count, s
        integer(i8) :: most_steps = huge(1_i8)   !! of a trajectory, where the method chooses them
        type(strobe_t) :: strobe                 !! samples are its points
        logical :: keeps_points = .false.        !! a row is a point, not a trajectory
        integer :: points = 1                    !! of a trajectory at most
        logical :: attractors = .false.          !! they are numbered at the end
        integer :: energy_by = 0                 !! velocity that makes all energies one; 0: none
        real(dp) :: energy = 0.0_dp              !! that of the scene's own start, J
        type(variational_t) :: variational       !! motion, by formulas of the parameters, if needed
    contains
        procedure :: match_energy
        procedure :: set_strobe
        procedure :: width
        procedure :: trajectories
        procedure :: places
        procedure :: coordinates_of
        procedure :: set_start
    end type sweep_t

    type :: sweep_box_t
        !! gfortran 12 needs it: modules that make the dispatch table of `sweep_t` for themselves
        !! disagree about its order.
        class(sweep_t), allocatable :: item
    end type sweep_box_t

contains

    subroutine new_sweep(sweep, scene, system, over, keep, seed, after, error)
        !! Everything that is refused is refused here, or by `compute_one` of the first trajectory.
        type(sweep_t), intent(out) :: sweep               !! ready to compute
        type(scene_t), intent(in) :: scene                !! each trajectory's, but for the axes
        class(system_t), intent(in) :: system             !! with the scene's parameters
        character(*), intent(in) :: over(:)               !! the axes, one or two
        character(*), intent(in) :: keep(:)               !! what is kept of each trajectory
        integer, intent(in) :: seed                       !! of the values that are drawn
        real(dp), intent(in) :: after                     !! samples before don't count, s
        type(error_t), allocatable, intent(out) :: error  !! names the key: over, keep, after
        character(sweep_text_length), allocatable :: events(:)
        type(random_t) :: random
        type(scene_t) :: trial
        real(dp) :: time
        integer :: i

        if (size(over) < 1 .or. size(over) > most_axes) then
            call fail(error, "one or two axes make a sweep, not "//to_text(size(over)), key="over")
            return
        else if (size(keep) < 1) then
            call fail(error, "nothing is kept of a trajectory", key="keep")
            return
        end if
        sweep%scene = scene
        if (allocated(sweep%scene%file)) deallocate (sweep%scene%file)
        allocate (sweep%system, source=system)
        call random%start(seed)
        allocate (sweep%axes(size(over)))
        do i = 1, size(over)
            call new_sweep_axis(sweep%axes(i), over(i), system, random, error)
            if (allocated(error)) then
                error%key = "over"
                error%element = i
                return
            end if
        end do
        call check_free(sweep, error)
        if (allocated(error)) return
        if (size(over) == 2) then
            if (sweep%axes(1)%changes_the_same(sweep%axes(size(over)))) then
                call fail(error, "both axes change "//trim(sweep%axes(1)%name), key="over")
                return
            end if
            if (real(sweep%axes(1)%count, dp)*sweep%axes(2)%count > most_trajectories) then
                call fail(error, to_text(sweep%axes(1)%count)//" times "// &
                          to_text(sweep%axes(2)%count)//" trajectories are too many: at most "// &
                          to_text(most_trajectories), key="over")
                return
            end if
        end if
        call read_kept(keep, system, sweep%kept, sweep%columns, events, error)
        if (allocated(error)) then
            error%key = "keep"
            return
        end if
        sweep%after = max(after, scene%t0)
        sweep%most_steps = scene%sweep%most_steps
        if (after > scene%t0 + scene%duration) then
            call fail(error, "lies behind the end, t = "//to_text(scene%t0 + scene%duration)// &
                      " s", key="after")
            return
        end if
        call plan_points(sweep, events, error)
        if (.not. allocated(error)) call plan_energy(sweep, error)
        if (allocated(error)) return
        sweep%events = size(events)
        call choose_events(sweep%scene, system, sweep%kept, events, sweep%stops, error)
        if (allocated(error)) return
        if (any(sweep%axes%is_parameter()) .or. any(is_lyapunov(sweep%kept%kind))) then
            call new_variational(sweep%variational, system)
        end if
        call adapt_scene(sweep)
        trial = sweep%scene
        if (.not. any(sweep%axes%is_parameter())) call sweep%set_strobe(trial, time, error)
    end subroutine new_sweep

    subroutine check_free(sweep, error)
        !! No axis may be a velocity that follows from the others.
        type(sweep_t), intent(in) :: sweep                !! with its axes
        type(error_t), allocatable, intent(out) :: error  !! names the axis, and what may be one
        type(description_t) :: d
        integer :: i, k

        if (.not. allocated(sweep%scene%given)) return
        associate (given => sweep%scene%given)
            do i = 1, size(sweep%axes)
                if (.not. any(sweep%axes(i)%is_velocity([(k, k=1, size(given))]) .and. &
                              .not. given)) cycle
                call sweep%system%describe(d)
                call fail(error, trim(sweep%axes(i)%name)//" follows from the other velocities "// &
                          "by the constraints; take one of "// &
                          join(pack(velocity_names(d), given), ", "), key="over")
                error%element = i
                return
            end do
        end associate
    end subroutine check_free

    subroutine plan_points(sweep, events, error)
        !! Points of a stroboscope or a section in the place of whole trajectories.
        type(sweep_t), intent(inout) :: sweep
        character(sweep_text_length), allocatable, intent(inout) :: events(:)
        type(error_t), allocatable, intent(out) :: error
        type(column_event_t) :: event
        type(description_t) :: d
        logical :: only_columns

        associate (group => sweep%scene%sweep, kept => sweep%kept)
            call new_strobe(sweep%strobe, group%strobe, sweep%system, error)
            if (allocated(error)) then
                error%key = "strobe"
                return
            end if
            sweep%attractors = any(kept%kind == keeps_attractor)
            sweep%keeps_points = (sweep%strobe%given .and. .not. sweep%attractors) .or. &
                                 group%section /= ""
            only_columns = all(kept%kind == keeps_end .or. kept%kind == keeps_wrapped)
            if (sweep%strobe%given .and. group%section /= "") then
                call fail(error, "points are either those of a stroboscope or of a section", &
                          key="section")
            else if (sweep%attractors .and. .not. sweep%strobe%given) then
                call fail(error, "an attractor is told by stroboscopic points: strobe = "// &
                          "'2 pi/drive_frequency', or any time where nothing is driven", key="keep")
            else if (sweep%keeps_points .and. .not. only_columns) then
                call sweep%system%describe(d)
                call fail(error, "of the points of a stroboscope or a section only columns are "// &
                          "kept, '"//trim(d%coordinates(1)%name)//"' or 'wrapped "// &
                          trim(d%coordinates(1)%name)//"'", key="keep")
            end if
            if (allocated(error) .or. .not. sweep%keeps_points) return
            sweep%points = group%points
            if (group%section == "") return
            call new_column_event(event, trim(group%section), sweep%system, error)
            if (allocated(error)) error%key = "section"
            events = [group%section]
        end associate
    end subroutine plan_points

    subroutine plan_energy(sweep, error)
        !! Which velocity gives every start the energy of the scene's own.
        type(sweep_t), intent(inout) :: sweep
        type(error_t), allocatable, intent(out) :: error
        type(description_t) :: d
        character(name_length), allocatable :: names(:)

        associate (scene => sweep%scene, by => sweep%scene%sweep%energy_by)
            if (by == "") return
            call sweep%system%describe(d)
            allocate (names, source=velocity_names(d))
            sweep%energy_by = findloc(names == by, .true., 1)
            sweep%energy = sweep%system%energy(scene%t0, scene%q, scene%v)
            if (sweep%energy_by == 0) then
                call fail(error, "a velocity is needed, not "//quoted(trim(by))//"; "// &
                          advice(trim(by), names), key="energy_by")
            else if (any(sweep%axes%is_velocity(sweep%energy_by))) then
                call fail(error, trim(by)//" cannot be an axis and be chosen by the energy", &
                          key="energy_by")
            else if (sweep%system%constraints > 0) then
                call fail(error, "others follow from it by the constraints; make it an axis", &
                          key="energy_by")
            else if (is_lost(sweep%system, scene%t0, scene%q, scene%v, sweep%energy_by)) then
                call fail(error, "velocities as those of the start are lost in the rounding of "// &
                          "its energy, "//to_text(sweep%energy)//" J; make "//trim(by)// &
                          " an axis", key="energy_by")
            end if
        end associate
    end subroutine plan_energy

    subroutine match_energy(self, system, q, v, error)
        !! Choose the velocity that `energy_by` names, the larger one that gives the energy of the
        !! scene's own start. Does nothing without that key.
        class(sweep_t), intent(in) :: self
        class(system_t), intent(in) :: system             !! of this trajectory
        real(dp), intent(in) :: q(:)                      !! its start
        real(dp), intent(inout) :: v(:)                   !! its velocities
        type(error_t), allocatable, intent(out) :: error  !! no velocity gives this energy
        logical :: found

        if (self%energy_by == 0) return
        call find_velocity(system, self%scene%t0, q, v, self%energy_by, self%energy, found)
        if (.not. found) call fail(error, "no "//trim(self%scene%sweep%energy_by)// &
                                   " gives this start the energy "//to_text(self%energy)//" J", &
                                   status_numbers)
    end subroutine match_energy

    pure subroutine set_strobe(self, scene, after, error)
        !! Samples at whole periods of the stroboscope, from the first that counts on no more than
        !! are kept; steps of fixed length are shortened so that a period is a whole number of them.
        class(sweep_t), intent(in) :: self
        type(scene_t), intent(inout) :: scene             !! of one trajectory, numbers set
        real(dp), intent(out) :: after                    !! samples before don't count, s
        type(error_t), allocatable, intent(out) :: error  !! the period is longer than the motion
        real(dp), parameter :: slack = 1e-9_dp  ! of a period
        real(dp) :: period
        integer(i8) :: first, last, steps

        after = self%after
        if (.not. self%strobe%given) return
        call self%strobe%period(scene%parameters, period, error)
        if (allocated(error)) return
        if (scene%duration/period > 1e9_dp) then
            call fail(error, "a period of "//to_text(period)//" s is too short for the duration", &
                      key="strobe")
            return
        end if
        first = ceiling((self%after - scene%t0)/period - slack, i8)
        last = floor(scene%duration/period + slack, i8)
        if (self%keeps_points) last = min(last, first + self%points - 1)
        if (last < max(first, 1_i8)) then
            call fail(error, "no point of the stroboscope, every "//to_text(period)//" s, lies "// &
                      "between 'after' and the end", key="strobe")
            return
        end if
        after = scene%t0 + (first - 0.5_dp)*period
        scene%duration = last*period
        scene%samples = last
        if (scene%tolerance > 0.0_dp) return
        steps = ceiling(period/scene%dt*(1.0_dp - slack), i8)
        scene%dt = period/steps
        scene%every = steps
        scene%samples = 0
    end subroutine set_strobe

    pure function width(self) result(n)
        !! Numbers of a trajectory: what is kept, of every point, and what tells its attractor.
        class(sweep_t), intent(in) :: self
        integer :: n

        n = size(self%kept)*self%points
        if (self%attractors) n = n + signature_size(self%system%ndof)
    end function width

    subroutine adapt_scene(sweep)
        !! The scene computes what is kept, and no more: no samples where none is looked at.
        type(sweep_t), intent(inout) :: sweep  !! knows its events
        integer(i8) :: steps

        associate (scene => sweep%scene, kept => sweep%kept)
            if (scene%method == auto) then
                scene%method = "dop853"
                if (.not. fits_lanes(sweep)) scene%method = workhorse
            end if
            scene%error_estimate = .false.
            if (any(kept%kind == keeps_largest .or. kept%kind == keeps_smallest .or. &
                    is_exact_extreme(kept%kind))) return
            scene%samples = min(scene%samples, 1_i8)
            if (scene%tolerance > 0.0_dp) return
            steps = nint(scene%duration/scene%dt, i8)
            scene%every = max(1_i8, steps)
        end associate
    end subroutine adapt_scene

    function fits_lanes(sweep) result(yes)
        !! Can the trajectories be computed in lanes? They go by steps of `rk4` or of a splitting
        !! method, or by `dop853` and a tolerance, what is kept is seen in the steps themselves, and
        !! they have one system, or one whose motion is known as formulas of its parameters. For a
        !! compiled system these pay by `dop853` and up to two coordinates; else its own equations
        !! alone take less time.
        type(sweep_t), intent(in) :: sweep  !! as `new_sweep` made it
        logical :: yes
        class(reduced_t), allocatable :: reduced
        type(row_t) :: splitting

        yes = follows_displacements(sweep)
        if (yes) return
        associate (scene => sweep%scene, system => sweep%system, kept => sweep%kept)
            yes = .not. (scene%compensated .or. sweep%stops) .and. system%contacts == 0 .and. &
                  system%constraints == 0 .and. &
                  (sweep%strobe%given .or. .not. sweep%keeps_points) .and. &
                  all(kept%kind == keeps_end .or. kept%kind == keeps_flip .or. &
                      kept%kind == keeps_largest .or. kept%kind == keeps_smallest .or. &
                      kept%kind == keeps_wrapped .or. kept%kind == keeps_attractor)
            if (any(sweep%axes%is_parameter())) yes = yes .and. sweep%variational%known .and. &
                (sweep%variational%is_code .or. scene%tolerance > 0.0_dp .and. system%ndof <= 2)
            if (scene%method == "rk4" .and. scene%tolerance <= 0.0_dp) return
            call find_row(scene%method, splitting)
            if (splitting%order > 0) then
                yes = yes .and. .not. system%velocity_forces
                return
            end if
            yes = yes .and. scene%method == "dop853"
            if (.not. yes) return
            call system%reduce(reduced)  ! a single trajectory leaves the cyclic coordinate out
            yes = .not. allocated(reduced)
        end associate
    end function fits_lanes

    pure function exponent_method(scene) result(name)
        !! By which Lyapunov exponents are computed: the scene's method where it keeps a tolerance,
        !! else the workhorse, with a tolerance of its own.
        type(scene_t), intent(in) :: scene  !! of a sweep
        character(:), allocatable :: name

        name = workhorse
        if (scene%tolerance > 0.0_dp) name = trim(scene%method)
    end function exponent_method

    pure function follows_displacements(sweep) result(yes)
        !! Are Lyapunov exponents all that is kept, and can they be computed in lanes: by `dop853`
        !! and formulas of the variational equations?
        type(sweep_t), intent(in) :: sweep  !! as `new_sweep` made it
        logical :: yes

        associate (scene => sweep%scene)
            yes = all(is_lyapunov(sweep%kept%kind)) .and. sweep%variational%known .and. &
                  scene%method == "dop853" .and. scene%tolerance > 0.0_dp .and. &
                  sweep%after < scene%t0 + scene%duration
        end associate
    end function follows_displacements

    pure function trajectories(self) result(n)
        !! How many.
        class(sweep_t), intent(in) :: self
        integer(i8) :: n
        integer :: i

        n = 1
        do i = 1, size(self%axes)
            n = n*self%axes(i)%count
        end do
    end function trajectories

    pure function places(self, index) result(which)
        !! Which value of each axis trajectory number `index` has.
        class(sweep_t), intent(in) :: self
        integer(i8), intent(in) :: index          !! from 1 to `trajectories`
        integer(i8) :: which(size(self%axes))
        integer(i8) :: rest
        integer :: i

        rest = index - 1
        do i = size(self%axes), 1, -1
            which(i) = mod(rest, self%axes(i)%count) + 1
            rest = rest/self%axes(i)%count
        end do
    end function places

    pure function coordinates_of(self, index) result(values)
        !! The values of the axes of trajectory number `index`.
        class(sweep_t), intent(in) :: self
        integer(i8), intent(in) :: index          !! from 1 to `trajectories`
        real(dp) :: values(size(self%axes))
        integer(i8) :: which(size(self%axes))
        integer :: i

        which = self%places(index)
        do i = 1, size(values)
            values(i) = self%axes(i)%value(which(i))
        end do
    end function coordinates_of

    subroutine set_start(self, index, q, v, parameters)
        !! Put the values of trajectory number `index` in their places; parameters that are not
        !! given follow from them, if they are allowed.
        class(sweep_t), intent(in) :: self
        integer(i8), intent(in) :: index                      !! from 1 to `trajectories`
        real(dp), intent(inout) :: q(:), v(:), parameters(:)  !! those of `scene`
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(error_t), allocatable :: error
        integer(i8) :: which(size(self%axes))
        integer :: i

        which = self%places(index)
        if (allocated(self%scene%computed)) where (self%scene%computed) &
            parameters = ieee_value(parameters, ieee_quiet_nan)
        do i = 1, size(which)
            call self%axes(i)%set(which(i), q, v, parameters)
        end do
        if (.not. any(ieee_is_nan(parameters))) return
        allocate (system, source=self%system)
        call system%configure(parameters, error)
        if (allocated(error)) return
        call system%describe(d)
        parameters = default_values(d)
    end subroutine set_start
end module lagrangia_sweep
