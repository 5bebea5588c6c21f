module lagrangia_report_page
    !! One page for a course: the scorecard, and for each scene its pictures, its film, and what the
    !! program says of its system.
    use lagrangia_animation, only: page_of_film
    use lagrangia_errors, only: error_t
    use lagrangia_files, only: read_whole_file
    use lagrangia_html, only: html_text, replaced, script_json, write_template
    use lagrangia_lecture_text, only: derivation_html, errata_html, lecture_html
    use lagrangia_outcome, only: outcome_t
    use lagrangia_plot_words, only: unicode_text
    use lagrangia_run_plan, only: run_plan_t
    use lagrangia_scorecard, only: scorecard_head, scorecard_legend, scorecard_lines, scorecard_row
    use lagrangia_shipped_files, only: shipped_text
    use lagrangia_text, only: to_text, word_t
    use lagrangia_version, only: build_text, version
    implicit none (type, external)
    private
    public :: report_page_t

    character, parameter :: newline = new_line("a")

    type :: report_page_t
        !! Scenes are added one by one; then `write`.
        private
        character(:), allocatable :: scores    !! rows of the scorecard
        character(:), allocatable :: contents  !! links
        character(:), allocatable :: sections
        integer :: scenes = 0
        integer :: pictures = 0
        type(word_t), allocatable :: texts(:)  !! on the systems so far, and
        integer, allocatable :: told(:)        !! in whose section they stand
    contains
        procedure :: begin_scene
        procedure :: add_picture
        procedure :: add_remark
        procedure :: add_film
        procedure :: add_lecture
        procedure :: write => write_page
    end type report_page_t

contains

    subroutine begin_scene(self, title, outcome)
        !! A scene that has been run, well or not.
        class(report_page_t), intent(inout) :: self
        character(*), intent(in) :: title       !! of the scene
        type(outcome_t), intent(in) :: outcome  !! its row of the scorecard
        type(word_t), allocatable :: lines(:)
        integer :: i

        if (self%scenes == 0) then
            self%scores = ""
            self%contents = ""
            self%sections = ""
            allocate (self%texts(0), self%told(0))
        else
            self%sections = self%sections//"</section>"//newline
        end if
        self%scenes = self%scenes + 1
        self%scores = self%scores//html_text(scorecard_row(outcome))//newline
        self%contents = self%contents//'<li><a href="#'//anchor(self%scenes)//'">'// &
                        html_text(unicode_text(title))//"</a></li>"//newline
        self%sections = self%sections//'<section id="'//anchor(self%scenes)//'">'//newline// &
                        "<h2>"//html_text(unicode_text(title))//"</h2>"//newline
        call self%add_remark(trim(outcome%scene)//": "//outcome%verdict())
        call scorecard_lines(outcome, .true., lines)
        if (size(lines) == 0) return
        self%sections = self%sections//"<pre>"
        do i = 1, size(lines)
            self%sections = self%sections//html_text(lines(i)%text)//newline
        end do
        self%sections = self%sections//"</pre>"//newline
    end subroutine begin_scene

    subroutine add_remark(self, text)
        !! Words in the section of the scene.
        class(report_page_t), intent(inout) :: self
        character(*), intent(in) :: text  !! one paragraph

        self%sections = self%sections//"<p>"//html_text(text)//"</p>"//newline
    end subroutine add_remark

    subroutine add_picture(self, path, title, error)
        !! A picture that gnuplot made, as part of the page.
        class(report_page_t), intent(inout) :: self
        character(*), intent(in) :: path   !! of an SVG file
        character(*), intent(in) :: title  !! what it shows
        type(error_t), allocatable, intent(out) :: error  !! status 5: it cannot be read
        character(:), allocatable :: svg, mark

        call read_whole_file(path, svg, error)
        if (allocated(error)) return
        self%pictures = self%pictures + 1
        mark = "p"//to_text(self%pictures)//"-"  ! names in one page must differ
        svg = svg(max(1, index(svg, "<svg")):)
        svg = replaced(svg, "id='", "id='"//mark)
        svg = replaced(svg, 'id="', 'id="'//mark)
        svg = replaced(svg, "'#", "'#"//mark)
        svg = replaced(svg, "url(#", "url(#"//mark)
        svg = replaced(svg, "<title>Gnuplot</title>", "<title>"// &
                       html_text(unicode_text(title))//"</title>")
        self%sections = self%sections//'<svg role="img"'//svg(5:)//newline
    end subroutine add_picture

    subroutine add_film(self, plan, film)
        !! A film, drawn by the program that stands once at the end of the page.
        class(report_page_t), intent(inout) :: self
        type(run_plan_t), intent(in) :: plan  !! of the scene
        character(*), intent(in) :: film      !! of `scene_film`

        self%sections = self%sections//'<div class="film">'//newline// &
            '<script type="application/json" class="film-data">'//newline// &
            script_json(page_of_film(plan, film))//newline//"</script>"//newline//"</div>"//newline
    end subroutine add_film

    subroutine add_lecture(self, plan)
        !! What there is to say of the system; if that was said of an earlier scene, where.
        class(report_page_t), intent(inout) :: self
        type(run_plan_t), intent(in) :: plan  !! of the scene
        type(word_t), allocatable :: more(:)
        character(:), allocatable :: text
        integer :: i

        text = lecture_html(plan%system)//derivation_html(plan%system)//errata_html(plan%system)
        do i = 1, size(self%texts)
            if (self%texts(i)%text /= text) cycle
            self%sections = self%sections//"<p>The lecture, the derivation and the slips in "// &
                'the notes: as of <a href="#'//anchor(self%told(i))// &
                '">the first scene of this system</a>.</p>'//newline
            return
        end do
        allocate (more(size(self%texts) + 1))
        do i = 1, size(self%texts)
            more(i)%text = self%texts(i)%text
        end do
        more(size(more))%text = text
        call move_alloc(more, self%texts)
        self%told = [self%told, self%scenes]
        self%sections = self%sections//text
    end subroutine add_lecture

    subroutine write_page(self, path, error)
        !! All of it. The file appears whole or not at all.
        class(report_page_t), intent(in) :: self  !! with one scene at least
        character(*), intent(in) :: path          !! of the page
        type(error_t), allocatable, intent(out) :: error  !! status 5: it cannot be written
        character(*), parameter :: title = "lagrangia: report"
        type(word_t) :: texts(4)
        character(:), allocatable :: style

        texts(1)%text = title
        call shipped_text("data/templates/film.css", texts(2)%text)
        call shipped_text("data/templates/report.css", style)
        texts(2)%text = texts(2)%text//style
        call shipped_text("data/templates/film.js", texts(3)%text)
        texts(4)%text = "<h1>"//title//"</h1>"//newline//"<p>lagrangia "//html_text(version)// &
            ", "//html_text(build_text())//"</p>"//newline//"<ol>"//newline//self%contents// &
            "</ol>"//newline//"<h2>Scorecard</h2>"//newline//'<pre tabindex="0">'// &
            html_text(scorecard_head())//newline//self%scores//newline// &
            html_text(scorecard_legend)//"</pre>"//newline//self%sections//"</section>"
        call write_template("data/templates/report.html", &
                            [character(6) :: "TITLE", "STYLE", "SCRIPT", "BODY"], texts, path, &
                            error)
    end subroutine write_page

    pure function anchor(i) result(name)
        !! Of the section of scene i.
        integer, intent(in) :: i
        character(:), allocatable :: name

        name = "scene-"//to_text(i)
    end function anchor
end module lagrangia_report_page
