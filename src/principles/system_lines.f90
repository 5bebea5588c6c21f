module lagrangia_system_lines
    !! Where in the notes a system comes from: one of the statements of `lagrangia course`.
    use lagrangia_course_table, only: course_of_the_notes, statement_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: line_of_system

    type :: place_t
        character(16) :: system = ""
        character(2) :: scan = ""  !! I or II
        integer :: line = 0        !! where the statement begins
    end type place_t

    type(place_t), parameter :: places(*) = [ &
        place_t("oscillator", "II", 28), place_t("pendulum", "I", 97), &
        place_t("double_pendulum", "I", 109), place_t("hanging_chain", "I", 109), &
        place_t("cart_pendulum", "I", 134), place_t("rolling_disk", "I", 126), &
        place_t("charged_particle", "I", 90), place_t("bouncing_ball", "I", 15), &
        place_t("atwood", "II", 74), place_t("wedge", "II", 89), &
        place_t("rotating_wire", "II", 72), place_t("rotating_hoop", "II", 72), &
        place_t("driven_pendulum", "II", 72)]

contains

    pure function line_of_system(name) result(text)
        !! `the notes, I 134-136: ...`, lecture, lines and a part of them, word for word; empty for
        !! a system that is not the lecture's.
        character(*), intent(in) :: name  !! of the system
        character(:), allocatable :: text
        type(statement_t), allocatable :: course(:)
        integer :: i, k

        text = ""
        k = findloc(places%system, name, 1)
        if (k == 0) return
        allocate (course, source=course_of_the_notes())
        do i = 1, size(course)
            if (course(i)%scan /= places(k)%scan .or. course(i)%line /= places(k)%line) cycle
            text = "the notes, "//trim(course(i)%scan)//" "//to_text(course(i)%line)
            if (course(i)%last > course(i)%line) text = text//"-"//to_text(course(i)%last)
            text = text//": "//trim(course(i)%quote)
            return
        end do
    end function line_of_system
end module lagrangia_system_lines
