module test_wrong_words
    !! Arguments that a command does not take get told what they are, or where they go; keys and
    !! columns by other names, and texts of a scene without quotes, how they are written.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t
    use lagrangia_registry, only: commands
    use lagrangia_run_plan, only: new_run_plan, run_plan_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_keys, only: keys
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use lagrangia_usual_keys, only: usual_key, usual_names
    use lagrangia_vocabulary, only: words_of
    use stated_text, only: is_said
    use typed_words, only: methods_go_behind_theirs, numbers_are_as_they_are_read, refused, &
                           settings_are_typed, taken, values_stand_behind_options
    implicit none (type, external)
    private
    public :: wrong_words_suite

    character(*), parameter :: feed = new_line("a"), needs = ": it is a text, and needs quotes: "

contains

    function wrong_words_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("wrong_words")
        call suite%addTest(TestMethod("two_words_are_a_name", two_words_are_a_name))
        call suite%addTest(TestMethod("lists_are_shown_elsewhere", lists_are_shown_elsewhere))
        call suite%addTest(TestMethod("names_go_elsewhere", names_go_elsewhere))
        call suite%addTest(TestMethod("options_stand_behind_hyphens", &
                                      options_stand_behind_hyphens))
        call suite%addTest(TestMethod("values_stand_behind_options", values_stand_behind_options))
        call suite%addTest(TestMethod("methods_go_behind_theirs", methods_go_behind_theirs))
        call suite%addTest(TestMethod("settings_are_typed", settings_are_typed))
        call suite%addTest(TestMethod("numbers_are_as_they_are_read", &
                                      numbers_are_as_they_are_read))
        call suite%addTest(TestMethod("other_programs_names", other_programs_names))
        call suite%addTest(TestMethod("formulas_need_quotes", formulas_need_quotes))
        call suite%addTest(TestMethod("slips_are_still_refused", slips_are_still_refused))
        call suite%addTest(TestMethod("other_texts_need_quotes", other_texts_need_quotes))
        call suite%addTest(TestMethod("lists_are_shown", lists_are_shown))
        call suite%addTest(TestMethod("texts_are_no_lists", texts_are_no_lists))
        call suite%addTest(TestMethod("settings_are_texts", settings_are_texts))
        call suite%addTest(TestMethod("other_reasons_stay", other_reasons_stay))
        call suite%addTest(TestMethod("one_argument_is_enough", one_argument_is_enough))
        call suite%addTest(TestMethod("good_words_pass", good_words_pass))
    end function wrong_words_suite

    subroutine two_words_are_a_name()
        !! With a blank where the name has a hyphen or a low line.
        character(*), parameter :: meant = "a name has no blank in it; did you mean '"

        call refused("principle virtual work", meant//"virtual-work'?")
        call refused("principle least action", meant//"action'?")
        call refused("describe double pendulum", meant//"double_pendulum'?")
        call refused("run cart pendulum wide", meant//"cart_pendulum_wide'?")
        call refused("run oscillator double pendulum", meant//"double_pendulum'?")
        call refused("compare cart pendulum small", meant//"cart_pendulum_small'?")
        call refused("check double pendulum", meant//"double_pendulum'?")
        call refused("stress near separatrix", meant//"near_separatrix'?")
    end subroutine two_words_are_a_name

    subroutine lists_are_shown_elsewhere()
        !! And all of them.
        call refused("describe scenes", "'lagrangia describe' takes no 'scenes'; 'lagrangia "// &
                     "list scenes' shows them")
        call refused("derive Systems", "'lagrangia derive' takes no 'Systems'; 'lagrangia "// &
                     "list systems' shows them")
        call refused("list principles", "'lagrangia list' takes no 'principles'; 'lagrangia "// &
                     "principle' shows them")
        call refused("help methods", "'lagrangia help' takes no 'methods'; 'lagrangia "// &
                     "list methods' shows them")
        call refused("check method", "'method' is no name; did you mean 'methods'?")
        call refused("run all", "'all' is no name; 'lagrangia' alone runs every scene")
        call refused("check all", "'all' is no name; 'lagrangia check' without a name takes all")
        call refused("sweep all", "'all' is no name; 'lagrangia list sweeps' shows the names")
        call refused("modes all", "'all' is no name; 'lagrangia list systems' shows the names")
    end subroutine lists_are_shown_elsewhere

    subroutine names_go_elsewhere()
        !! What another command takes.
        call refused("describe rk4", "'rk4' is a method; 'lagrangia list methods' tells of it, "// &
                     "'lagrangia help describe' shows what 'describe' takes")
        call refused("run pendulum rk4", "'rk4' is a method; write '--set scene%method=rk4', "// &
                     "'lagrangia help run' shows what 'run' takes")
        call refused("describe resonance", "'resonance' is a sweep; 'lagrangia sweep "// &
                     "resonance' goes with it, 'lagrangia help describe' shows what "// &
                     "'describe' takes")
        call refused("stress pendulum", "'pendulum' is a system; 'lagrangia describe pendulum' "// &
                     "goes with it, 'lagrangia help stress' shows what "// &
                     "'stress' takes")
        call refused("describe dt", "'dt' is a key of a scene; 'lagrangia describe scene' "// &
                     "tells of it, 'lagrangia help describe' shows what 'describe' takes")
    end subroutine names_go_elsewhere

    subroutine options_stand_behind_hyphens()
        !! And their values behind them; `help` tells of any option and of any name.
        character(*), parameter :: none = "'GIF' is no format that '--plot' draws; there are "// &
            "png, svg, pdf; '--animate' writes a film as an HTML page"

        call refused("run pendulum --plot GIF", none)
        call refused("modes pendulum GIF --plot", none)
        call refused("sweep basins --plot eps", "'eps' is no format that '--plot' draws; there "// &
                     "are png, svg, pdf")
        call refused("run pendulum PDF", "'PDF' is a format of pictures; write '--plot=pdf'")
        call refused("run pendulum csv", "'csv' is a format; write '--format csv'")
        call refused("modes pendulum Json", "'Json' is an option, which two hyphens go "// &
                     "before: --json")
        call refused("help plot", "'plot' is an option, --plot[=png|svg|pdf]: draw the data "// &
                     "files by gnuplot, as in 'lagrangia run SCENE... --plot'")
        call refused("help --slip E1", "option '--slip' does not go with 'lagrangia help'; it "// &
                     "takes none but --help; --slip ID: derive with this slip of the notes, as "// &
                     "in 'lagrangia derive SYSTEM|SCENE --slip'")
        call refused("run pendulum --svg", "unknown option '--svg'; write --plot=svg")
        call refused("sweep basins --csv", "unknown option '--csv'; write --format csv")
        call refused("run pendulum --movie", "unknown option '--movie'; did you mean '--animate'?")
        call refused("run pendulum --tmax 5", "unknown option '--tmax'; a key of the scene "// &
                     "says that: --set scene%duration=...")
        call refused("run --all", "unknown option '--all'; 'lagrangia' alone runs every scene")
        call refused("sweep pendulum theta=0:1:5", "'theta=0:1:5' is an axis; write '--over "// &
                     "theta=0:1:5'")
        call refused("run pendulum pendulum%l=2", "'pendulum%l=2' is a setting; write '--set "// &
                     "pendulum%l=2'")
        call refused("run pendulum dt=0.1", "'dt=0.1' is a setting; write '--set scene%dt=0.1'")
        call refused("run pendulum l=0.1", "'l=0.1' is a setting; write '--set pendulum%l=0.1'")
        call refused("run pendulum theta=1", "'theta=1' is a start; write '--set scene%q=1'")
        call refused("run pendulum Theta_dot=1", "'Theta_dot=1' is a start; write '--set "// &
                     "scene%v=1'")
        call refused("compare double_pendulum theta2=1", "'theta2=1' is a start; write --set "// &
                     "'scene%q(2)=1'")
        call refused("sweep ueda x=1", "'x=1' is a start; write '--set scene%q=1'")
        call refused("sweep ueda theta=1", "'theta=1' is no setting of ueda, whose parameters "// &
                     "are b, c, f; write '--set ueda%b=...'")
        call refused("modes pendulum theta=1", "'theta=1' is a place; write '--at 1'")
        call refused("modes double_pendulum theta1=1", "'theta1=1' is a place; an equilibrium "// &
                     "is '--at Q1,Q2,...', with all coordinates")
        call refused("check pendulum q=1", "'q=1' is no setting of pendulum, whose parameters "// &
                     "are m, l, g, b; write '--set pendulum%m=...'")
        call refused("run l=2", "'l=2' is a setting; a scene or system goes before it, as in "// &
                     "'lagrangia run pendulum --set pendulum%l=2'")
        call refused("modes double_pendulum --at 0 0", "'0' is a number; the place of an "// &
                     "equilibrium is '--at Q1,Q2,...', with commas and no blanks")
        call refused("compare pendulum 1 2", "'1' is a number; starts are ""--starts 'Q1,Q2 "// &
                     "Q1,Q2'"", with blanks between them")
        call refused("help sweep Keep", "'Keep' is an option, --keep COLUMN|period|...: what "// &
                     "is kept of each trajectory, as in 'lagrangia sweep SCENE --keep'")
        call refused("help RK4", "'RK4' is a method; 'lagrangia list methods' tells of it")
        call refused("help kepler", "'kepler' is a scene; 'lagrangia run kepler' goes with it")
        call refused("help pendulum", "'pendulum' is a system; 'lagrangia describe pendulum' "// &
                     "goes with it")
        call refused("sweep pendulum run", "'run' is a command; 'lagrangia help run' tells of "// &
                     "it, 'lagrangia help sweep' shows what 'sweep' takes")
    end subroutine options_stand_behind_hyphens

    subroutine other_programs_names()
        !! Of keys, columns and what is kept; each of the usual names means a key that there is.
        character(*), parameter :: start = "&scene system = 'pendulum', dt = 0.1, duration = "// &
            "1, q = 1 "
        integer :: i

        call refused_scene(start//", tmax = 5 /", &
                           "a.nml:1:61: &scene: unknown key 'tmax'; did you mean 'duration'?")
        call refused_scene(start//"Solver = 'rk4' /", "unknown key 'solver'; did you mean "// &
                           "'method'?")
        call refused_scene(start//"columns = 'omega' /", "'omega': unknown column 'omega'; did "// &
                           "you mean 'theta_dot'?")
        call refused_scene(start//"columns = 'Time' /", "did you mean 't'?")
        call refused_scene(start//"columns = 'E' /", "did you mean 'energy'?")
        call refused_scene(start//"columns = 'x' /", "unknown column 'x'; pendulum has t, "// &
                                                     "theta, theta_dot, theta_ddot, energy, "// &
                                                     "energy_drift, L_z, tension, x_bob, y_bob")
        do i = 1, size(usual_names)
            call assertTrue(any(keys == usual_key(trim(usual_names(i)))), usual_names(i))
            call assertFalse(any(keys == usual_names(i)), usual_names(i))
        end do
        call assertEqual("", usual_key("colour"))
        call assertEqual("", usual_key(""))
    end subroutine other_programs_names

    subroutine formulas_need_quotes()
        !! Whatever the parser makes of them.
        character(28), parameter :: texts(*) = [character(28) :: "1/2 m v^2", "m x_dot^2", &
            "(m/2) x_dot^2", "0.5*m*x_dot^2", "m x_dot^2 / 2", "$m$", "atan2(x, m)", "-m*x^2"]
        integer :: i

        do i = 1, size(texts)
            call refused_scene("&lagrangian"//feed//"  T = "//trim(texts(i))//feed//"/", &
                         "a.nml:2:7: &lagrangian: T"//needs//"T = '"//trim(texts(i))//"'")
        end do
        call refused_scene("&lagrangian T=2 x_dot^2, ! kinetic"//feed//"/", &
                     "a.nml:1:15: &lagrangian: T"//needs//"T = '2 x_dot^2'")
        call refused_scene("&lagrangian T=2 x_dot^2, V = 0 /", &
                     "a.nml:1:15: &lagrangian: T"//needs//"T = '2 x_dot^2'")
        call refused_scene("&lagrangian T = m x'^2 /", &
                     "a.nml:1:17: &lagrangian: T"//needs//'T = "m x''^2"')
        call refused_scene("&lagrangian Q_x = 1/2 k /", &
                     "a.nml:1:19: &lagrangian: Q_x"//needs//"Q_x = '1/2 k'")
    end subroutine formulas_need_quotes

    subroutine other_texts_need_quotes()
        !! Titles, names of files, events.
        call refused_scene("&scene title = 60 degrees /", &
                     "a.nml:1:16: &scene: title"//needs//"title = '60 degrees'")
        call refused_scene("&scene output = my/file /", &
                     "a.nml:1:17: &scene: output"//needs//"output = 'my/file'")
        call refused_scene("&scene event = theta = 0 rising, dt = 1 /", &
                     "a.nml:1:16: &scene: event"//needs//"event = 'theta = 0 rising'")
        call refused_scene("&sweep strobe = 2 pi/w /", &
                     "a.nml:1:17: &sweep: strobe"//needs//"strobe = '2 pi/w'")
    end subroutine other_texts_need_quotes

    subroutine lists_are_shown()
        !! Where each text has quotes of its own.
        character(*), parameter :: stand = ": its texts stand between quotes, as in "

        call refused_scene("&scene columns = t theta /", "a.nml:1:18: &scene: columns"//stand// &
                     "columns = 't', 'theta', 'theta_dot', 'energy_drift'")
        call refused_scene("&sweep keep = max theta /", "a.nml:1:15: &sweep: keep"//stand// &
                     "keep = 'period', 'max theta_dot'")
    end subroutine lists_are_shown

    subroutine texts_are_no_lists()
        !! In a file also a text that could be several values, or one value several times.
        call refused_scene("&lagrangian V=2*x /", "a.nml:1:15: &lagrangian: V"//needs//"V = '2*x'")
        call refused_scene("&lagrangian V=2*x*y, T=1 /", "&lagrangian: V"//needs//"V = '2*x*y'")
        call refused_scene("&lagrangian V=2 k /", "a.nml:1:15: &lagrangian: V"//needs//"V = '2 k'")
        call refused_scene("&lagrangian V=k x /", "a.nml:1:15: &lagrangian: V"//needs//"V = 'k x'")
        call refused_scene("&lagrangian Q_x=2*x_dot /", "&lagrangian: Q_x"//needs// &
                           "Q_x = '2*x_dot'")
        call refused_scene("&sweep strobe=2*T_0 /", "&sweep: strobe"//needs//"strobe = '2*T_0'")
    end subroutine texts_are_no_lists

    subroutine settings_are_texts()
        !! Behind `--set` a text needs no quotes, also if it begins like a number.
        character(16), parameter :: texts(*) = [character(16) :: "2*x", "3*x^2", "2 k (x-1)^2", &
            "1/2 k x^2", "(k/2) x^2", "-2*k*x", "2*3*x", "2", ".5*x", "1e-3 x", "2*", "1d-3 x"]
        integer :: i

        do i = 1, size(texts)
            call same_as_quoted("lagrangian%V=", trim(texts(i)))
            call same_as_quoted("lagrangian%Q_x = ", trim(texts(i)))
        end do
        call same_as_quoted("scene%title=", "2 pendulums, 3 springs")
        call same_as_quoted("lagrangian%V=", "0,5 x")
        call same_as_quoted("sweep%strobe=", "2 pi/k")
    end subroutine settings_are_texts

    subroutine same_as_quoted(setting, text)
        !! Assert that the text without quotes is taken as with them, or refused as well.
        character(*), intent(in) :: setting, text
        character(:), allocatable :: bare, marked

        call read_set(setting//text, bare)
        call read_set(setting//"'"//text//"'", marked)
        call assertEqual(marked, bare, message=setting//text)
    end subroutine same_as_quoted

    subroutine read_set(setting, shown)
        !! The title and the formulas of a scene with the setting, or why it is refused.
        character(*), intent(in) :: setting
        character(:), allocatable, intent(out) :: shown
        character(*), parameter :: scene = "&scene system='z', dt=0.1, duration=1, q=1, v=0 / "// &
            "&lagrangian coordinates='x', parameters='k', T='x_dot^2/2', V='x^2' / &z k=1 /"
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(scene_t) :: read
        type(word_t) :: overrides(1)
        integer :: i

        overrides(1)%text = setting
        call parse_scene(scene, "a.nml", overrides, read, system, error)
        if (allocated(error)) then
            shown = error%message(index(error%message, ": &"):)
            return
        end if
        shown = trim(read%title)//trim(read%sweep%strobe)
        do i = 1, size(read%formulas)
            shown = shown//trim(read%formulas(i))
        end do
    end subroutine read_set

    subroutine other_reasons_stay()
        !! Of numbers, of texts that have quotes, of what is wrong in another line.
        call refused_scene("&scene dt = 1/2 /", "a.nml:1:13: &scene: dt: '1/2': a number is "// &
                     "needed, nothing is computed; write 0.5")
        call refused_scene("&lagrangian T = 'm (x'^2)' /", "a.nml:1:23: &lagrangian: t: "// &
                     "unexpected '^' behind a text; a quote within it is doubled")
        call refused_scene("&pendulum m = 1/2 /", "a.nml:1:15: &pendulum: m: '1/2': a number "// &
                     "is needed, nothing is computed; write 0.5")
    end subroutine other_reasons_stay

    subroutine slips_are_still_refused()
        !! What the unchanged scene has not either, and what is set itself.
        character(*), parameter :: start = "&scene system='pendulum' dt=0.1 duration=1 q=1 "

        call changed(start//"columns='t','thta' /", "pendulum%b=0.1", &
                     "unknown column 'thta'; did you mean 'theta'?")
        call changed(start//"plot='thta' /", "pendulum%b=0.1", &
                     "'thta' is none of this scene's columns; did you mean 'theta'?")
        call changed(start//"expect_enrgy=1 /", "pendulum%b=0.1", &
                     "unknown key 'expect_enrgy'; did you mean 'expect_energy'?")
        call changed(start//"/ &pendulum b=0.1 /", "scene%expect_energy_drift=1", &
                     "not conserved, for generalised forces do work")
        call changed(start//"/", "pendulum%b=0.1;scene%columns=t,energy_drift", "not "// &
                     "conserved, for generalised forces do work; there is 'energy_balance_drift'")
        call changed(start//"tolerance=1 /", "pendulum%b=0.1", "method 'rk4' takes steps of "// &
                     "dt; methods that keep a tolerance: gauss16, dop853")
        call changed(start//"every=0 /", "scene%dt=0.01", "every = 0: at least 1 is needed")
    contains
        subroutine changed(text, settings, message)
            character(*), intent(in) :: text, settings, message

            call refused_scene(text, message, settings)
        end subroutine changed
    end subroutine slips_are_still_refused

    subroutine refused_scene(text, message, setting)
        !! Assert that the scene, perhaps with settings, is refused, and that the message ends so.
        character(*), intent(in) :: text, message
        character(*), intent(in), optional :: setting  !! one, or two with `;` between them
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(run_plan_t) :: plan
        type(scene_t) :: scene
        type(word_t), allocatable :: overrides(:)
        integer :: cut

        cut = 0
        if (present(setting)) cut = index(setting, ";")
        allocate (overrides(merge(1, 0, present(setting)) + merge(1, 0, cut > 0)))
        if (cut > 0) overrides(1)%text = setting(:cut - 1)
        if (present(setting)) overrides(size(overrides))%text = setting(cut + 1:)
        call parse_scene(text, "a.nml", overrides, scene, system, error)
        if (.not. allocated(error)) call new_run_plan(plan, scene, system, error)
        call assertTrue(allocated(error), text)
        if (allocated(error)) call assertTrue(is_said(error%message, message), error%message)
    end subroutine refused_scene

    subroutine one_argument_is_enough()
        !! Of those commands that take one.
        call refused("compare pendulum oscillator", "'lagrangia compare' takes one argument, "// &
                     "SCENE, and 'oscillator' is a second one; several scenes in one picture: "// &
                     "'lagrangia run pendulum oscillator --plot --overlay'")
        call refused("errata E1 E2", "'lagrangia errata' takes one argument, [ID], and 'E2' is "// &
                     "a second one")
        call refused("manual x", "'lagrangia manual' takes no argument, and 'x' is one")
    end subroutine one_argument_is_enough

    subroutine good_words_pass()
        !! Each word that a command takes, alone and two by two; what nothing here knows, and files.
        character(:), allocatable :: kinds
        type(word_t), allocatable :: words(:)
        integer :: i, k

        do i = 2, size(commands)
            kinds = trim(commands(i)%takes)//" "
            do while (len(kinds) > 1)
                call words_of(kinds(:index(kinds, " ") - 1), words)
                kinds = kinds(index(kinds, " ") + 1:)
                do k = 1, size(words)
                    call taken(trim(commands(i)%name)//" "//words(k)%text)
                    if (commands(i)%most < 0 .and. k > 1) call taken(trim(commands(i)%name)//" "// &
                        words(k - 1)%text//" "//words(k)%text)
                end do
            end do
        end do
        call taken("run nosuch")
        call taken("run ./all")
        call taken("grade data")
        call taken("run Pendulum")
        call taken("show pendulum atwood.nml")
        call taken("errata "//to_text(7))
    end subroutine good_words_pass
end module test_wrong_words
