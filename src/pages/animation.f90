module lagrangia_animation
    !! A scene as a film: one HTML page that needs nothing else, no network and no server.
    use lagrangia_channels, only: bytes_beside, bytes_of_number
    use lagrangia_data_files, only: film_path
    use lagrangia_description, only: description_t, figure_length
    use lagrangia_errors, only: error_t, fail
    use lagrangia_film, only: count_channels, film_json
    use lagrangia_frames, only: add_reference, film_speed, find_pace, finer_run, finer_words, &
                                frames_t, record_frames, window_of
    use lagrangia_html, only: html_text, script_json, write_template
    use lagrangia_json, only: json_array, json_element, json_item, json_object, json_pair, &
                              json_string
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_zero
    use lagrangia_plot_words, only: unicode_text
    use lagrangia_run_files, only: method_text
    use lagrangia_run_plan, only: run_plan_t
    use lagrangia_scene, only: heading
    use lagrangia_shipped_files, only: shipped_text
    use lagrangia_system, only: system_t
    use lagrangia_text, only: in_words, to_text, word_t
    implicit none (type, external)
    private
    public :: animate_both, animate_scene, page_of_film, page_of_films, scene_film, write_page

    integer, parameter :: most_bytes = 215000      !! of the series of a page, of 300 kB
    integer, parameter :: least_frames = 120
    integer, parameter :: most_frames = 4000
    integer, parameter :: frames_for_two = 400     !! where there are fewer, one motion is shown

contains

    subroutine animate_scene(plan, path, error)
        !! Write the page of a scene, `NAME.html` beside its data.
        type(run_plan_t), intent(in) :: plan  !! of the scene; may have been run
        character(*), intent(in) :: path      !! of its data file
        type(error_t), allocatable, intent(out) :: error  !! 2, 3 or 5: why there is none
        character(:), allocatable :: film

        call scene_film(plan, film, error)
        if (allocated(error)) return
        call write_page(film_path(path), heading(plan%scene), page_of_film(plan, film), error)
    end subroutine animate_scene

    subroutine animate_both(one, other, path, error)
        !! Write the page of a scene by two methods, the second drawn beside the first.
        type(run_plan_t), intent(in) :: one, other  !! of one scene; may have been run
        character(*), intent(in) :: path            !! of the page
        type(error_t), allocatable, intent(out) :: error  !! 2, 3 or 5: why there is none
        character(:), allocatable :: film, title

        call scene_film(one, film, error, other)
        if (allocated(error)) return
        title = heading(one%scene)
        call write_page(path, title, page_of_films(one%system, title, &
            method_text(one%settled)//"; beside it: "//method_text(other%settled), &
            json_element(film)), error)
    end subroutine animate_both

    subroutine scene_film(plan, film, error, beside)
        !! The film of a scene, as JSON for `page_of_films`.
        type(run_plan_t), intent(in) :: plan               !! of the scene; may have been run
        character(:), allocatable, intent(out) :: film     !! one object
        type(error_t), allocatable, intent(out) :: error   !! 2: too many parts; 3: the numbers
        type(run_plan_t), intent(in), optional :: beside
        !! the same scene by another method; absent: the closed form or a finer run is beside it
        type(frames_t) :: probe, frames, reference
        character(:), allocatable :: members, title, note
        real(dp) :: omega, window
        character(figure_length), allocatable :: own(:)
        integer :: channels, count

        allocate (own(0))
        if (allocated(plan%scene%figure)) own = plan%scene%figure
        associate (scene => plan%settled, system => plan%system)
            call find_pace(scene, system, plan%closed_form, probe, omega, error)
            if (.not. allocated(error)) call count_channels(system, own, probe, channels, error)
            if (allocated(error)) return
            count = room_for(2*channels)
            if (count < frames_for_two .and. .not. present(beside)) count = room_for(channels)
            if (count < least_frames) then
                call fail(error, "no film of so many moving parts fits into a page of 300 kB")
                return
            end if
            window = window_of(scene%duration, omega, count)
            call record_frames(scene, system, plan%closed_form, window, count, frames, error)
            if (allocated(error)) return
            title = ""
            if (present(beside)) then
                title = trim(beside%settled%method)
                call record_frames(beside%settled, system, beside%closed_form, window, count, &
                                   reference, error)
                if (allocated(error)) call error%add_context(title)
                if (allocated(error)) return
                frames%count = min(frames%count, reference%count)  ! an event may stop one earlier
                reference%count = frames%count
            else if (count == room_for(2*channels)) then
                call add_reference(scene, system, plan%closed_form, frames, reference, title)
            end if
            call film_json(system, own, frames, reference, members, error)
            if (allocated(error)) return
            note = ""
            if (window < scene%duration) note = "the first "//to_text(window)// &
                " s of "//to_text(scene%duration)//" s"
            if (title == finer_run .and. note /= "") note = note//"; "
            if (title == finer_run) note = note//finer_run//": "//finer_words()
            film = json_object(json_pair("name", trim(scene%name))//json_pair("note", note)// &
                               json_pair("factor", film_speed(window, omega))// &
                               json_pair("loop", .false.)//json_pair("reference", title)//members)
        end associate
    end subroutine scene_film

    pure integer function room_for(channels)
        !! Frames of so many series.
        integer, intent(in) :: channels

        room_for = min(most_frames, (most_bytes - bytes_beside*channels)/ &
                       (bytes_of_number*channels))
    end function room_for

    function page_of_film(plan, film) result(json)
        !! What a page says beside the film of a scene.
        type(run_plan_t), intent(in) :: plan  !! of the scene
        character(*), intent(in) :: film      !! of `scene_film`
        character(:), allocatable :: json

        json = page_of_films(plan%system, heading(plan%scene), method_text(plan%settled), &
                             json_element(film))
    end function page_of_film

    function page_of_films(system, title, method, films) result(json)
        !! The data of a page.
        class(system_t), intent(in) :: system         !! whose films they are
        character(*), intent(in) :: title, method     !! of the page; how they were computed
        character(*), intent(in) :: films             !! each a `json_element`
        character(:), allocatable :: json, facts
        type(description_t) :: d
        character(:), allocatable :: name, values
        integer :: i, k

        call system%describe(d)
        facts = json_element(json_string(method))
        do i = 1, size(d%parameters)
            associate (p => d%parameters(i))
                if (all(is_zero(p%value(:p%count)))) cycle
                values = ""
                do k = 1, p%count
                    values = values//" "//to_text(p%value(k))
                end do
                if (p%whole) values = " "//to_text(nint(p%value(1)))
                if (p%unit /= "1") values = values//" "//trim(p%unit)
                facts = facts//json_element(json_string(said(trim(p%name))//" ="// &
                                                        unicode_text(values)))
            end associate
        end do
        name = in_words(d%name)
        if (d%title /= "" .and. d%title /= title) name = name//": "//d%title
        json = json_object(json_pair("title", unicode_text(title))// &
                           json_pair("system", unicode_text(name))// &
                           json_item("facts", json_array(facts))// &
                           json_item("films", json_array(films)))
    end function page_of_films

    pure function said(name) result(text)
        !! A parameter in words: `drive frequency`; a letter with an index stays one, `m_block`.
        character(*), intent(in) :: name
        character(:), allocatable :: text

        text = unicode_text(name)
        if (text == name .and. index(name, "_") > 2) text = in_words(name)
    end function said

    subroutine write_page(path, title, json, error)
        !! The page of one or more films of one system. It appears whole or not at all.
        character(*), intent(in) :: path         !! of the file; folders are made
        character(*), intent(in) :: title, json  !! of the page; of `page_of_films`
        type(error_t), allocatable, intent(out) :: error  !! status 5: it cannot be written
        type(word_t) :: texts(4)

        texts(1)%text = html_text(unicode_text(title))
        call shipped_text("data/templates/film.css", texts(2)%text)
        call shipped_text("data/templates/film.js", texts(3)%text)
        texts(4)%text = script_json(json)
        call write_template("data/templates/animation.html", &
                            [character(6) :: "TITLE", "STYLE", "SCRIPT", "DATA"], texts, path, &
                            error)
    end subroutine write_page
end module lagrangia_animation
