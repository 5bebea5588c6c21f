module rewritings
    !! Statements in other words: equivalent ones, and ones with a single slip.
    use lagrangia_exact_number, only: ratio
    use lagrangia_expression, only: expression_t, f_cos, f_sin, kind_difference, kind_function, &
                                    kind_negation, kind_number, kind_power, kind_product, &
                                    kind_quotient, kind_sum, kind_symbol, node_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_random_draws, only: random_t
    use lagrangia_sample_names, only: role_acceleration, role_coordinate, role_parameter, &
                                        role_time, &
                                        role_velocity, samples_t
    implicit none (type, external)
    private
    public :: draw_rewriting, draw_slip

contains

    subroutine draw_rewriting(expression, random)
        !! Every node, by chance, in another form that is always equal to it.
        type(expression_t), intent(inout) :: expression
        type(random_t), intent(inout) :: random
        type(expression_t) :: new
        integer :: place(expression%count), i, a, b, c, next

        do i = 1, expression%count
            associate (node => expression%nodes(i))
                a = 0
                b = 0
                if (node%left > 0) a = place(node%left)
                if (node%right > 0) b = place(node%right)
                select case (node%kind)
                case (kind_number)
                    call new%add_number(node%number, place(i))
                case (kind_symbol)
                    call new%add_symbol(node%which, place(i))
                case (kind_sum)
                    if (one_of(random, 2) == 1) then
                        call new%add_operation(kind_sum, b, a, place(i))
                    else
                        call new%add_operation(kind_negation, b, 0, c)
                        call new%add_operation(kind_difference, a, c, place(i))
                    end if
                case (kind_difference)
                    call new%add_operation(kind_negation, b, 0, c)
                    call new%add_operation(kind_sum, c, a, place(i))
                case (kind_product)
                    call new%add_operation(kind_product, b, a, place(i))
                    if (one_of(random, 3) == 1) then  ! twice half of it
                        call whole(new, 2, c)
                        call new%add_operation(kind_quotient, place(i), c, b)
                        call new%add_operation(kind_product, c, b, place(i))
                    end if
                case (kind_quotient)
                    call whole(new, -1, c)
                    call new%add_operation(kind_power, b, c, next)
                    b = next
                    call new%add_operation(kind_product, b, a, place(i))
                case (kind_power)
                    call new%add_operation(kind_power, a, b, place(i))
                    if (is_two(expression, node%right)) then
                        call new%add_operation(kind_product, a, a, place(i))
                    end if
                case (kind_negation)
                    call whole(new, -1, c)
                    call new%add_operation(kind_product, c, a, place(i))
                case default
                    call rewrite_function(new, node%which, a, one_of(random, 3), place(i))
                end select
            end associate
        end do
        expression = new%pruned(place(expression%count))
    end subroutine draw_rewriting

    subroutine whole(expression, value, place)
        type(expression_t), intent(inout) :: expression
        integer, intent(in) :: value
        integer, intent(out) :: place

        call expression%add_number(ratio(int(value, i8), 1_i8), place)
    end subroutine whole

    logical function is_two(expression, i)
        type(expression_t), intent(in) :: expression
        integer, intent(in) :: i

        is_two = .false.
        if (expression%nodes(i)%kind /= kind_number) return
        is_two = abs(expression%nodes(i)%number%value - 2.0_dp) <= 0.0_dp
    end function is_two

    subroutine rewrite_function(new, which, a, choice, place)
        !! sin(a) = 2 sin(a/2) cos(a/2), cos(a) = 1 - 2 sin(a/2)^2, or as it is.
        type(expression_t), intent(inout) :: new
        integer, intent(in) :: which, a, choice
        integer, intent(out) :: place
        integer :: half, two, one, s, c, next

        if (choice > 1 .or. (which /= f_sin .and. which /= f_cos)) then
            call new%add_operation(kind_function, a, 0, place, which)
            return
        end if
        call whole(new, 2, two)
        call new%add_operation(kind_quotient, a, two, half)
        call new%add_operation(kind_function, half, 0, s, f_sin)
        if (which == f_sin) then
            call new%add_operation(kind_function, half, 0, c, f_cos)
            call new%add_operation(kind_product, s, c, place)
            call new%add_operation(kind_product, two, place, next)
            place = next
        else
            call whole(new, 1, one)
            call new%add_operation(kind_power, s, two, place)
            call new%add_operation(kind_product, two, place, next)
            place = next
            call new%add_operation(kind_difference, one, place, next)
            place = next
        end if
    end subroutine rewrite_function

    subroutine draw_slip(expression, samples, random, kind)
        !! One node changed: a sign, a function, a letter, an exponent, a factor, or a term lost.
        type(expression_t), intent(inout) :: expression
        type(samples_t), intent(in) :: samples
        type(random_t), intent(inout) :: random
        character(:), allocatable, intent(out) :: kind  !! "" if nothing could be changed there
        type(expression_t) :: new
        integer :: place(expression%count), i, k, chosen, c, next

        chosen = one_of(random, expression%count)
        kind = ""
        do i = 1, expression%count
            call copy_node(expression%nodes(i))
            if (i /= chosen) cycle
            associate (node => expression%nodes(i))
                select case (node%kind)
                case (kind_symbol)
                    select case (one_of(random, 3))
                    case (1)
                        k = one_of(random, size(samples%role))
                        if (k == node%which .or. .not. alike(samples%role(k), &
                            samples%role(node%which))) return
                        kind = "letter"
                        call new%add_symbol(k, place(i))
                    case (2)
                        kind = "exponent"
                        call whole(new, 2, c)
                        call new%add_operation(kind_power, place(i), c, next)
                        place(i) = next
                    case default
                        kind = "factor"
                        call whole(new, 2, c)
                        call new%add_operation(kind_product, c, place(i), next)
                        place(i) = next
                    end select
                case (kind_function)
                    kind = "function"
                    if (node%which /= f_sin .and. node%which /= f_cos) return
                    call new%add_operation(kind_function, place(node%left), 0, place(i), &
                                           f_sin + f_cos - node%which)
                case (kind_sum)
                    kind = "sign"
                    call new%add_operation(kind_difference, place(node%left), place(node%right), &
                                           place(i))
                    if (one_of(random, 2) == 1) then
                        kind = "lost term"
                        place(i) = place(node%left)
                    end if
                case (kind_difference)
                    kind = "sign"
                    call new%add_operation(kind_sum, place(node%left), place(node%right), place(i))
                    if (one_of(random, 2) == 1) then
                        kind = "lost term"
                        place(i) = place(node%left)
                    end if
                case (kind_power)
                    if (.not. is_two(expression, node%right)) return
                    kind = "exponent"
                    place(i) = place(node%left)
                case (kind_product)
                    kind = "lost factor"
                    place(i) = place(node%right)
                case default
                    return
                end select
            end associate
        end do
        if (kind /= "") expression = new%pruned(place(expression%count))
    contains
        subroutine copy_node(node)
            type(node_t), intent(in) :: node

            if (node%kind == kind_number) then
                call new%add_number(node%number, place(i))
            else if (node%kind == kind_symbol) then
                call new%add_symbol(node%which, place(i))
            else if (node%right == 0) then
                call new%add_operation(node%kind, place(node%left), 0, place(i), node%which)
            else
                call new%add_operation(node%kind, place(node%left), place(node%right), place(i))
            end if
        end subroutine copy_node
    end subroutine draw_slip

    integer function one_of(random, n)
        !! From 1 to `n`.
        type(random_t), intent(inout) :: random
        integer, intent(in) :: n
        real(dp) :: x

        call random%uniform(0.0_dp, 1.0_dp, x)
        one_of = 1 + min(n - 1, int(n*x))
    end function one_of

    pure logical function alike(a, b)
        integer, intent(in) :: a, b
        integer, parameter :: moving(*) = [role_time, role_coordinate, role_velocity, &
                                           role_acceleration]

        alike = (a == role_parameter .and. b == role_parameter) .or. (any(moving == a) .and. &
            any(moving == b))
    end function alike
end module rewritings
