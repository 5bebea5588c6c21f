module lagrangia_composition_table
    !! Drifts and kicks of symmetric splitting methods, as fractions of the step.
    !!
    !! Most are compositions of Verlet steps by the fractions \(\gamma_s\): neighbours of the same
    !! kind are merged. The last row is not: its drifts and kicks are chosen one by one, for forces
    !! of positions only (Runge-Kutta-Nystrom), and give the smallest error for the work.
    !!
    !! Each row holds a first half, which the second mirrors. Of the rows of order 6 and 8 the
    !! papers print 15 to 26 digits; the others come from Newton's method on the order conditions,
    !! which the tests evaluate in quadruple precision. Where conditions are fewer than numbers,
    !! \(\gamma_1\) is the printed one, and in the last row no number moves by more than 4e-15.
    use lagrangia_description, only: line_length, name_length
    use lagrangia_kinds, only: dp, qp
    implicit none (type, external)
    private
    public :: find_row, nth_row, round_row, row_t

    type :: row_t
        character(name_length) :: name = ""
        character(line_length) :: title = ""  !! a few words and the source
        integer :: order = 0                  !! 0: there is no such row
        real(dp) :: step_limit = 0.0_dp       !! \(\omega h\) where a step's trace leaves [-2, 2]
        logical :: kick_first = .false.       !! made of velocity Verlet: kick, drift, kick
        real(qp), allocatable :: gamma(:)     !! of a composition; their sum is 1
        real(qp), allocatable :: drift(:)     !! one more than `kick`, or one less
        real(qp), allocatable :: kick(:)
    end type row_t

    real(qp), parameter :: yoshida4(2) = [ &
        1.351207191959657634047687808971460827_qp, -1.702414383919315268095375617942921654_qp]
    real(qp), parameter :: suzuki4(3) = [ &
        0.4144907717943757371423540628607614957_qp, 0.4144907717943757371423540628607614957_qp, &
        -0.6579630871775029485694162514430459828_qp]
    real(qp), parameter :: yoshida6(4) = [ &
        0.7845136104775572638194976338663498758_qp, 0.2355732133593581336847931829785346017_qp, &
        -1.177679984178871006946415680964315735_qp, 1.315186320683911218884249728238862514_qp]
    real(qp), parameter :: kahan_li6(5) = [ &
        0.39216144400731413927925056_qp, 0.3325991367893594385997486342572743557_qp, &
        -0.706246172557639359809964819634910351_qp, 0.0822135962935508002314904488531569177_qp, &
        0.7985439909348299633989503530489581552_qp]
    real(qp), parameter :: yoshida8(8) = [ &
        0.9148442462297915667487934898475096045_qp, 0.2536933365662113541461460206899420761_qp, &
        -1.444852236860605157694730657537390355_qp, -0.1582406353680501752040667767597542478_qp, &
        1.938139137622525986579186487443641761_qp, -1.960610232975310807607633376399663641_qp, &
        0.1027998493917964406981151316012258629_qp, 1.708453070787281584668379362228977878_qp]
    real(qp), parameter :: kahan_li8(9) = [ &
        0.13020248308889008087881763_qp, 0.5611629817751083845619644076820001026_qp, &
        -0.3894749626448472864080785930431669971_qp, 0.1588419065551556008962107466776823932_qp, &
        -0.3959038941332375773362315434661316715_qp, 0.1845396409783157070918325433640865162_qp, &
        0.2583743876863220472939791116954259737_qp, 0.2950117236093102988709662367574629766_qp, &
        -0.6055085338300345116989210793347185876_qp]
    real(qp), parameter :: blanes_moan6_drift(8) = [ &
        0.0378593198406110162865159809190632294_qp, 0.1026356331024366056085846916203014958_qp, &
        -0.025867888266558350325440151671851957_qp, 0.3142414030714464093086677858675286509_qp, &
        -0.130144459517415197015791085344301124_qp, 0.1064177003695418294877994883146706907_qp, &
        -0.008794243128510174632638512563910949573_qp, 0.2073050690568957225646036057169999274_qp]
    real(qp), parameter :: blanes_moan6_kick(7) = [ &
        0.09171915262446217541522945138967863019_qp, 0.1839831700050048822786243402697313138_qp, &
        -0.05653436583288916926143176486259971935_qp, &
        0.004914688774711813118083983049593023226_qp, &
        0.1437611271683618419692682385199129899_qp, 0.3285676937468034573566523214506330551_qp, &
        -0.1964114664864550008764265698169492928_qp]

contains

    pure subroutine nth_row(i, row)
        !! One method.
        integer, intent(in) :: i         !! from 1
        type(row_t), intent(out) :: row  !! of order 0 beyond the end

        select case (i)
        case default
            row%order = 0
        case (1)
            call fill(row, "verlet", 2, 2.0_dp, [1.0_qp], "drift, kick, drift (Verlet 1967)")
        case (2)
            call fill(row, "velocity_verlet", 2, 2.0_dp, [1.0_qp], &
                      "kick, drift, kick: leapfrog (Verlet 1967)", .true.)
        case (3)
            call fill(row, "yoshida4", 4, 1.573402_dp, yoshida4, &
                      "3 Verlet steps (Forest & Ruth, Yoshida 1990)")
        case (4)
            call fill(row, "suzuki4", 4, 2.720975_dp, suzuki4, "5 Verlet steps (Suzuki 1990)")
        case (5)
            call fill(row, "yoshida6", 6, 2.269058_dp, yoshida6, &
                      "7 Verlet steps (Yoshida 1990, solution A)")
        case (6)
            call fill(row, "kahan_li6", 6, 2.532627_dp, kahan_li6, &
                      "9 Verlet steps (Kahan & Li 1997, s9odr6a)")
        case (7)
            call fill(row, "yoshida8", 8, 2.356508_dp, yoshida8, &
                      "15 Verlet steps (Yoshida 1990, solution D)")
        case (8)
            call fill(row, "kahan_li8", 8, 3.096439_dp, kahan_li8, &
                      "17 Verlet steps (Kahan & Li 1997, s17odr8a)")
        case (9)
            row%name = "blanes_moan6"
            row%title = "14 kicks, the best of these (Blanes & Moan 2002, SRKN14a)"
            row%order = 6
            row%step_limit = 3.140925_dp
            row%drift = [blanes_moan6_drift, blanes_moan6_drift(7:1:-1)]
            row%kick = [blanes_moan6_kick, blanes_moan6_kick(7:1:-1)]
        end select
    end subroutine nth_row

    pure subroutine find_row(name, row)
        !! The method of this name.
        character(*), intent(in) :: name  !! as in a scene
        type(row_t), intent(out) :: row   !! of order 0 where there is none
        integer :: i

        i = 0
        do
            i = i + 1
            call nth_row(i, row)
            if (row%order == 0 .or. row%name == name) return
        end do
    end subroutine find_row

    pure subroutine round_row(row, drift, kick, node)
        !! As the steps use it.
        type(row_t), intent(in) :: row                           !! of the table
        real(dp), allocatable, intent(out) :: drift(:), kick(:)  !! fractions of the step
        real(dp), allocatable, intent(out) :: node(:)            !! where accelerations are needed
        real(qp) :: reached
        integer :: s

        drift = real(row%drift, dp)
        kick = real(row%kick, dp)
        node = drift
        reached = 0.0_qp
        do s = 1, size(node)
            reached = reached + row%drift(s)
            node(s) = real(reached, dp)
        end do
    end subroutine round_row

    pure subroutine fill(row, name, order, step_limit, half, title, kick_first)
        !! A composition of Verlet steps: mirror the half that the table gives, and merge.
        type(row_t), intent(inout) :: row
        character(*), intent(in) :: name, title
        integer, intent(in) :: order
        real(dp), intent(in) :: step_limit
        real(qp), intent(in) :: half(:)
        logical, intent(in), optional :: kick_first
        real(qp) :: gamma(2*size(half) - 1), shared(2*size(half))

        row%name = name
        row%title = title
        row%order = order
        row%step_limit = step_limit
        gamma = [half, half(size(half) - 1:1:-1)]
        shared = 0.5_qp*([gamma, 0.0_qp] + [0.0_qp, gamma])
        row%gamma = gamma
        row%drift = shared
        row%kick = gamma
        if (present(kick_first)) row%kick_first = kick_first
        if (.not. row%kick_first) return
        row%drift = gamma
        row%kick = shared
    end subroutine fill
end module lagrangia_composition_table
