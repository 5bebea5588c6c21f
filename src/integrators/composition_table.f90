module lagrangia_composition_table
    !! Symmetric compositions of Verlet steps: the fractions \(\gamma_s\) of the step, as data.
    !!
    !! Each row holds the first half and the middle; the second half mirrors the first. Of the
    !! rows of order 6 and 8 the books print 15 to 26 digits; the others come from Newton's method
    !! on the order conditions, which the tests evaluate in quadruple precision. Where a condition
    !! is missing, \(\gamma_1\) is the printed number.
    use lagrangia_description, only: line_length, name_length
    use lagrangia_kinds, only: qp
    implicit none (type, external)
    private
    public :: row_t, nth_row

    type :: row_t
        character(name_length) :: name = ""
        character(line_length) :: title = ""  !! a few words and the source
        integer :: order = 0                  !! 0: there is no such row
        logical :: kick_first = .false.       !! made of velocity Verlet: kick, drift, kick
        real(qp), allocatable :: gamma(:)     !! all fractions; their sum is 1
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

contains

    pure subroutine nth_row(i, row)
        !! Row `i`; of order 0 beyond the end.
        integer, intent(in) :: i
        type(row_t), intent(out) :: row

        select case (i)
        case default
            row%order = 0
        case (1)
            call fill(row, "verlet", 2, [1.0_qp], "drift, kick, drift (Verlet 1967)")
        case (2)
            call fill(row, "velocity_verlet", 2, [1.0_qp], &
                      "kick, drift, kick: leapfrog (Verlet 1967)")
            row%kick_first = .true.
        case (3)
            call fill(row, "yoshida4", 4, yoshida4, "3 Verlet steps (Forest & Ruth, Yoshida 1990)")
        case (4)
            call fill(row, "suzuki4", 4, suzuki4, "5 Verlet steps (Suzuki 1990)")
        case (5)
            call fill(row, "yoshida6", 6, yoshida6, "7 Verlet steps (Yoshida 1990, solution A)")
        case (6)
            call fill(row, "kahan_li6", 6, kahan_li6, "9 Verlet steps (Kahan & Li 1997, s9odr6a)")
        case (7)
            call fill(row, "yoshida8", 8, yoshida8, "15 Verlet steps (Yoshida 1990, solution D)")
        case (8)
            call fill(row, "kahan_li8", 8, kahan_li8, "17 Verlet steps (Kahan & Li 1997, s17odr8a)")
        end select
    end subroutine nth_row

    pure subroutine fill(row, name, order, half, title)
        !! Mirror the half that the table gives.
        type(row_t), intent(inout) :: row
        character(*), intent(in) :: name, title
        integer, intent(in) :: order
        real(qp), intent(in) :: half(:)

        row%name = name
        row%title = title
        row%order = order
        row%gamma = [half, half(size(half) - 1:1:-1)]
    end subroutine fill
end module lagrangia_composition_table
