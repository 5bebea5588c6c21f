module typed_words
    !! What is said of the words of a command line, and the tests of the remedies in it that are
    !! options: they can be typed.
    use funit, only: assertEqual, assertFalse, assertTrue
    use lagrangia_command_line, only: command_line_t, parse_words, word_t
    use lagrangia_errors, only: error_t, status_usage
    use lagrangia_registry, only: check_line, commands, options
    use lagrangia_typed_option, only: as_read, typed_option
    use lagrangia_wrong_words, only: check_arguments
    implicit none (type, external)
    private
    public :: methods_go_behind_theirs, numbers_are_as_they_are_read, settings_are_typed, &
              values_stand_behind_options
    public :: refused, taken

contains

    subroutine check(text, error)
        !! What is said of the words of `text`.
        character(*), intent(in) :: text
        type(error_t), allocatable, intent(out) :: error
        type(command_line_t) :: line
        type(word_t), allocatable :: words(:)
        integer :: first, i, which

        allocate (words(count([(text(i:i) == " ", i=1, len(text))]) + 1))
        first = 1
        do i = 1, size(words)
            words(i)%text = text(first:first + index(text(first:)//" ", " ") - 2)
            first = first + len(words(i)%text) + 1
        end do
        call parse_words(words, options, line, error)
        if (.not. allocated(error)) call check_line(line, which, error)
        if (.not. allocated(error)) call check_arguments(commands(which), line%arguments, &
                                                         line%values_of("set"), error)
    end subroutine check

    subroutine refused(text, message)
        !! Assert that the words of `text` are refused so.
        character(*), intent(in) :: text     !! with a blank between two words
        character(*), intent(in) :: message  !! the whole of it
        type(error_t), allocatable :: error

        call check(text, error)
        call assertTrue(allocated(error), "refused: "//text)
        if (.not. allocated(error)) return
        call assertEqual(message, error%message)
        call assertEqual(status_usage, error%status)
    end subroutine refused

    subroutine taken(text)
        !! Assert that the words of `text` pass.
        character(*), intent(in) :: text  !! with a blank between two words
        type(error_t), allocatable :: error

        call check(text, error)
        call assertFalse(allocated(error), "taken: "//text)
    end subroutine taken

    subroutine values_stand_behind_options()
        !! Not alone, with `=`; keys of the scene and what it expects stand behind `--set`.
        call refused("sweep pendulum over=theta=0:1:5", "'over=theta=0:1:5' is an option; "// &
                     "write '--over theta=0:1:5'")
        call refused("sweep pendulum keep=period", "'keep=period' is an option; write '--keep "// &
                     "period'")
        call refused("compare pendulum starts=1", "'starts=1' is an option; write '--starts 1'")
        call refused("modes pendulum at=1", "'at=1' is an option; write '--at 1'")
        call refused("run pendulum plot=png", "'plot=png' is an option; write '--plot=png'")
        call refused("run pendulum plot=theta", "'plot=theta' is a setting; write '--set "// &
                     "scene%plot=theta'")
        call refused("run pendulum quiet=1", "'quiet=1' is an option, which takes no value: "// &
                     "--quiet")
        call refused("run pendulum expect_period=1", "'expect_period=1' is a setting; write "// &
                     "'--set scene%expect_period=1'")
        call refused("run pendulum expect_perod=1", "'expect_perod=1' is no setting; did you "// &
                     "mean 'expect_period'?")
        call refused("run pendulum expect_foo=1", "'expect_foo=1' is no setting; what can be "// &
                     "bounded is expect_ and one of t, theta, theta_dot, theta_ddot, energy, "// &
                     "energy_drift, l_z, tension, x_bob, y_bob, error, period, small_period")
    end subroutine values_stand_behind_options

    subroutine methods_go_behind_theirs()
        !! And systems and problems of the benchmark; lists have their own names.
        character(*), parameter :: help = ", 'lagrangia help "

        call refused("compare pendulum rk4,verlet", "'rk4,verlet' is a list of methods; write "// &
                     "'--methods rk4,verlet'"//help//"compare' shows what 'compare' takes")
        call refused("compare pendulum rk4", "'rk4' is a method; another one is compared with "// &
                     "it: '--methods rk4,gauss16'"//help//"compare' shows what 'compare' takes")
        call refused("compare pendulum nosuch", "'lagrangia compare' takes one argument, "// &
                     "SCENE, and 'nosuch' is a second one")
        call refused("bench pendulum", "'pendulum' is a system; write '--systems pendulum'"// &
                     help//"bench' shows what 'bench' takes")
        call refused("bench P1", "'P1' is a problem; write '--problems P1'"//help// &
                     "bench' shows what 'bench' takes")
        call refused("bench rk4", "'rk4' is a method; write '--methods rk4'"//help// &
                     "bench' shows what 'bench' takes")
        call refused("list method", "'method' is no name; did you mean 'methods'?")
        call refused("list integrator", "'lagrangia list' takes no 'integrator'; 'lagrangia "// &
                     "list methods' shows them")
    end subroutine methods_go_behind_theirs

    subroutine settings_are_typed()
        !! With a group, and with quotes where a shell needs them; a scene that is not there is the
        !! command's to refuse.
        call refused("modes pendulum theta=pi", "'theta=pi' is a place; write '--at "// &
                     "3.141592653589793'")
        call refused("run pendulum --set theta_dot=pi/2", "--set theta_dot=pi/2: this is a "// &
                     "start; write '--set scene%v=1.5707963267948966'")
        call refused("run pendulum l=$2", "'l=$2' is a setting; write --set 'pendulum%l=$2'")
        call refused("run pendulum title='$2'", "'title='$2'' is a setting; write --set "// &
                     """scene%title='\$2'""")
        call refused("run pendulum --set tmax=5", "--set tmax=5: this is no setting; did you "// &
                     "mean '--set scene%duration=5'?")
        call refused("run pendulum durration=5", "'durration=5' is no setting; did you mean "// &
                     "'--set scene%duration=5'?")
        call taken("run pendulum --set scene=1")
        call taken("run nosuch.nml r=1")
        call taken("run nosuch --set r=1")
    end subroutine settings_are_typed

    subroutine numbers_are_as_they_are_read()
        !! What is no number stays.
        call assertEqual("3.141592653589793,0,x", as_read("pi,0,x"))
        call assertEqual("0.7853981633974483", as_read("45 deg"))
        call assertEqual("0.5", as_read("1/2"))
        call assertEqual("", as_read(""))
        call assertEqual("--at ''", typed_option("at", ""))
        call assertEqual("'--plot=png'", typed_option("plot=", "png"))
        call assertEqual("--set 'scene%q(2)=1'", typed_option("set", "scene%q(2)=1"))
    end subroutine numbers_are_as_they_are_read
end module typed_words
