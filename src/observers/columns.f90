module lagrangia_columns
    !! Named columns: from a name such as `theta_dot` or `energy_drift` to a number a state.
    use lagrangia_description, only: described_by, description_t, name_length
    use lagrangia_errors, only: error_t, fail
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_names, only: nearest_name
    use lagrangia_system, only: system_t
    use lagrangia_text, only: listed, lower, quoted
    implicit none (type, external)
    private
    public :: columns_t, new_columns, column_names
    public :: refuse_work, why_energy_changes
    public :: is_error, is_quantity

    integer, parameter :: is_time = 1, is_coordinate = 2, is_velocity = 3, is_acceleration = 4
    integer, parameter :: is_energy = 5, is_quantity = 6, is_position = 7
    integer, parameter :: is_error = 8  !! distance from the truth: not a function of the state
    integer, parameter :: is_work = 9, is_balance = 10  !! nor are these: the whole motion counts

    type :: column_t
        character(name_length) :: name = ""
        character(16) :: unit = "1"
        integer :: kind = 0
        integer :: index = 0          !! which coordinate, quantity or point
        integer :: axis = 0           !! of a position
        logical :: drift = .false.    !! change since the start, divided by `scale`
        real(dp) :: start = 0.0_dp
        real(dp) :: scale = 0.0_dp
    end type column_t

    type :: columns_t
        !! What is asked for, and no more: only that is evaluated.
        type(column_t), allocatable :: items(:)
        integer(i8) :: energy_evaluations = 0
        logical :: started = .false.
        integer :: points = 0
        logical :: needs_accelerations = .false.
        logical :: needs_work = .false.
    contains
        procedure :: evaluate
        procedure :: names
        procedure :: units
    end type columns_t

contains

    pure subroutine new_columns(self, names, system, has_error, error)
        !! Resolve `names`; fails at one that the system does not have.
        type(columns_t), intent(out) :: self  !! the columns in the order of the names
        character(*), intent(in) :: names(:)  !! each at most once
        class(system_t), intent(in) :: system  !! with its parameters
        logical, intent(in) :: has_error  !! an `error` column can be given
        type(error_t), allocatable, intent(out) :: error  !! blames an element of `columns`
        type(column_t), allocatable :: all(:)
        type(description_t) :: d
        integer :: i, j

        call system%describe(d)
        call every_column(d, system%conserves_energy(), has_error, all)
        allocate (self%items(size(names)))
        do i = 1, size(names)
            do j = 1, size(all)
                if (all(j)%name == names(i)) exit
            end do
            if (j > size(all)) then
                call refuse(trim(names(i)), system, d, all, error)
            else if (any(names(:i - 1) == names(i))) then
                call fail(error, "the column is there already")
            end if
            if (allocated(error)) then
                error%key = "columns"
                error%element = i
                return
            end if
            self%items(i) = all(j)
        end do
        self%needs_accelerations = any(self%items%kind == is_acceleration)
        self%needs_work = any(self%items%kind == is_work .or. self%items%kind == is_balance)
        if (any(self%items%kind == is_position)) self%points = size(d%points)
    end subroutine new_columns

    pure function column_names(system, has_error) result(names)
        !! Every column that a system has.
        class(system_t), intent(in) :: system  !! with its parameters
        logical, intent(in) :: has_error  !! `error` is one of them
        character(name_length), allocatable :: names(:)
        type(column_t), allocatable :: all(:)
        type(description_t) :: d

        call system%describe(d)
        call every_column(d, system%conserves_energy(), has_error, all)
        names = all%name
    end function column_names

    pure subroutine every_column(d, conserves_energy, has_error, all)
        !! The whole list of a system's columns.
        type(description_t), intent(in) :: d
        logical, intent(in) :: conserves_energy, has_error
        type(column_t), allocatable, intent(out) :: all(:)
        character(1), parameter :: axes(3) = ["x", "y", "z"]
        type(column_t) :: c
        integer :: i, k, count

        allocate (all(6 + 3*size(d%coordinates) + 2*size(d%quantities) &
                      + d%dimensions*size(d%points)))
        count = 0
        call append(all, count, column_t(name="t", unit="s", kind=is_time))
        do i = 1, size(d%coordinates)
            associate (q => d%coordinates(i))
                call append(all, count, column_t(q%name, q%unit, is_coordinate, i))
                call append(all, count, column_t(trim(q%name)//"_dot", trim(q%unit)//"/s", &
                                                 is_velocity, i))
                call append(all, count, column_t(trim(q%name)//"_ddot", trim(q%unit)//"/s^2", &
                                                 is_acceleration, i))
            end associate
        end do
        c = column_t("energy", "J", is_energy, scale=d%energy_scale)
        call append(all, count, c)
        if (conserves_energy) then
            call append(all, count, drift_of(c))
        else
            call append(all, count, column_t("work", "J", is_work))
            c = column_t("energy_balance", "J", is_balance, scale=d%energy_scale)
            call append(all, count, c)
            call append(all, count, drift_of(c))
        end if
        do i = 1, size(d%quantities)
            associate (f => d%quantities(i))
                c = column_t(f%name, f%unit, is_quantity, i, scale=f%scale)
                call append(all, count, c)
                if (f%conserved) call append(all, count, drift_of(c))
            end associate
        end do
        do i = 1, size(d%points)
            do k = 1, d%dimensions
                call append(all, count, column_t(axes(k)//"_"//d%points(i)%name, "m", &
                                                 is_position, i, k))
            end do
        end do
        if (has_error) call append(all, count, column_t("error", "1", is_error))
        all = all(:count)
    end subroutine every_column

    pure subroutine set_scale(column, system, t, q, v)
        !! What a drift is relative to: where it starts, or the natural size of what may start at
        !! zero; of terms that cancel there but for rounding, these.
        type(column_t), intent(inout) :: column  !! has its start
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        real(dp), parameter :: rounding = 1e3_dp*epsilon(1.0_dp)
        real(dp) :: terms

        column%scale = max(abs(column%start), column%scale)
        terms = system%natural_size(merge(column%index, 0, column%kind == is_quantity), t, q, v)
        if (column%scale <= rounding*terms) column%scale = terms
        if (column%scale <= 0.0_dp) column%scale = 1.0_dp
    end subroutine set_scale

    pure function drift_of(column) result(drift)
        !! The relative change of a conserved column since the start.
        type(column_t), intent(in) :: column
        type(column_t) :: drift

        drift = column
        drift%name = trim(column%name)//"_drift"
        drift%unit = "1"
        drift%drift = .true.
    end function drift_of

    pure subroutine append(list, count, item)
        !! `item` behind the first `count`; there is room.
        type(column_t), intent(inout) :: list(:)
        integer, intent(inout) :: count
        type(column_t), intent(in) :: item

        count = count + 1
        list(count) = item
    end subroutine append

    pure subroutine refuse_work(self, error)
        !! Where only one state is known.
        class(columns_t), intent(in) :: self                        !! the columns
        type(error_t), allocatable, intent(inout) :: error          !! allocated if one needs more

        if (allocated(error) .or. .not. self%needs_work) return
        call fail(error, "the work is summed along the samples, and is no function of one "// &
                  "state; it can stand in columns only")
    end subroutine refuse_work

    pure function why_energy_changes(system) result(text)
        !! Of a system that does not conserve its energy.
        class(system_t), intent(in) :: system  !! with its parameters
        character(:), allocatable :: text

        text = "L contains the time"
        if (system%constraints_work) text = "a constraint does work"
        if (system%nonconservative .and. .not. system%workless) then
            text = "generalised forces do work"
        end if
    end function why_energy_changes

    pure subroutine refuse(name, system, d, all, error)
        !! Say why there is no column `name`.
        character(*), intent(in) :: name
        class(system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        type(column_t), intent(in) :: all(:)
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: near
        character(name_length) :: names(size(all))

        names = all%name
        near = usual_column(name, trim(d%coordinates(1)%name))
        if (count(names == near) == 0) near = nearest_name(name, names)
        if (name == "error") then
            call fail(error, "column 'error': "//trim(d%name)//" has no closed form from this "// &
                      "start; with expect_error it is estimated")
        else if (name == "energy_drift") then
            call fail(error, "column 'energy_drift': the energy of this "//trim(d%name)// &
                      " is not conserved, for "//why_energy_changes(system)// &
                      "; there is 'energy_balance_drift'")
        else if (system%conserves_energy() .and. &
                 any(name == [character(20) :: "work", "energy_balance", &
                              "energy_balance_drift"])) then
            call fail(error, "column "//quoted(name)//": the energy of this "//trim(d%name)// &
                      " is conserved; 'energy_drift' says how well")
        else if (any(d%quantities%name == without_drift(name) .and. &
                     without_drift(name) /= name)) then
            call fail(error, "column "//quoted(name)//": "//without_drift(name)//" of this "// &
                      trim(d%name)//" is not conserved; there is "//quoted(without_drift(name)))
        else if (index(name, ",") > 0) then
            call fail(error, "is one text; each column has its own quotes, as in 't', 'x'")
        else if (near /= "") then
            call fail(error, "unknown column "//quoted(name)//"; did you mean '"//near//"'?")
        else
            call fail(error, "unknown column "//quoted(name)//"; "//trim(d%name)//" has "// &
                      listed(names, 130, described_by(d)))
        end if
    end subroutine refuse

    pure function usual_column(name, q) result(column)
        !! What others call a column that there may be; empty for other names.
        character(*), intent(in) :: name, q  !! what was asked for, and a coordinate
        character(:), allocatable :: column

        select case (lower(name))
        case ("time"); column = "t"
        case ("e", "h", "hamiltonian", "total_energy", "e_total"); column = "energy"
        case ("v", "velocity", "speed", "omega", "qdot", "q_dot"); column = q//"_dot"
        case ("a", "acceleration", "alpha"); column = q//"_ddot"
        case ("angle", "position", "q"); column = q
        case default; column = ""
        end select
    end function usual_column

    pure function without_drift(name) result(text)
        !! `A_x` of `A_x_drift`; other names as they are.
        character(*), intent(in) :: name
        character(:), allocatable :: text

        text = trim(name)
        if (len(text) > 6) then
            if (text(len(text) - 5:) == "_drift") text = text(:len(text) - 6)
        end if
    end function without_drift

    pure function names(self, count) result(list)
        !! The names of the first `count` columns.
        class(columns_t), intent(in) :: self
        integer, intent(in) :: count  !! at most all
        character(name_length) :: list(count)

        list = self%items(:count)%name
    end function names

    pure function units(self, count) result(list)
        !! The units of the first `count` columns.
        class(columns_t), intent(in) :: self
        integer, intent(in) :: count  !! at most all
        character(16) :: list(count)

        list = self%items(:count)%unit
    end function units

    subroutine evaluate(self, system, t, q, v, deviation, row, work)
        !! One number a column. The first call sets where drifts start.
        class(columns_t), intent(inout) :: self
        class(system_t), intent(in) :: system  !! the one that the columns were made for
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)  !! s; coordinates, velocities
        real(dp), intent(in) :: deviation  !! what the column `error` shows
        real(dp), intent(out) :: row(size(self%items))  !! in the units of the columns
        real(dp), intent(in), optional :: work  !! since the start, J; zero if it is not known
        real(dp) :: a(system%ndof), energy, done
        type(hyperdual_t) :: r(3, self%points), tt, qq(system%ndof)
        integer :: i
        logical :: known

        known = .false.
        energy = 0.0_dp
        done = 0.0_dp
        if (present(work)) done = work
        if (self%needs_accelerations) call system%accelerations(t, q, v, a)
        if (self%points > 0) then
            tt%re = t
            qq%re = q
            call system%positions(tt, qq, r)
        end if
        do i = 1, size(self%items)
            associate (c => self%items(i))
                select case (c%kind)
                case (is_time)
                    row(i) = t
                case (is_coordinate)
                    row(i) = q(c%index)
                case (is_velocity)
                    row(i) = v(c%index)
                case (is_acceleration)
                    row(i) = a(c%index)
                case (is_work)
                    row(i) = done
                case (is_energy, is_balance)
                    if (.not. known) then
                        energy = system%energy(t, q, v)
                        self%energy_evaluations = self%energy_evaluations + 1
                        known = .true.
                    end if
                    row(i) = energy
                    if (c%kind == is_balance) row(i) = energy - done
                case (is_quantity)
                    row(i) = system%quantity(c%index, t, q, v)
                case (is_position)
                    row(i) = r(c%axis, c%index)%re
                case default
                    row(i) = deviation
                end select
                if (c%drift) then
                    if (.not. self%started) then
                        c%start = row(i)
                        call set_scale(c, system, t, q, v)
                    end if
                    row(i) = (row(i) - c%start)/c%scale
                end if
            end associate
        end do
        self%started = .true.
    end subroutine evaluate
end module lagrangia_columns
