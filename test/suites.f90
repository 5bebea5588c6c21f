module suites
    !! Every suite. A new one takes two lines: one `use`, one `addTest`.
    use funit, only: TestSuite
    use test_accuracy, only: accuracy_suite
    use test_action, only: action_suite
    use test_all_paths, only: all_paths_suite
    use test_amplitude, only: amplitude_suite
    use test_audit, only: audit_suite
    use test_audit_formulas, only: audit_formulas_suite
    use test_auto, only: auto_suite
    use test_bench, only: bench_suite
    use test_bench_files, only: bench_files_suite
    use test_blas_threads, only: blas_threads_suite
    use test_bouncing_ball, only: bouncing_ball_suite
    use test_brief_force, only: brief_force_suite
    use test_canonical, only: canonical_suite
    use test_canonical_form, only: canonical_form_suite
    use test_canonical_maps, only: canonical_maps_suite
    use test_cart_pendulum, only: cart_pendulum_suite
    use test_catalogue, only: catalogue_suite
    use test_changed_scene, only: changed_scene_suite
    use test_characters, only: characters_suite
    use test_charged_particle, only: charged_particle_suite
    use test_charged_particle_reference, only: charged_particle_reference_suite
    use test_columns, only: columns_suite
    use test_command_line, only: command_line_suite
    use test_compensated, only: compensated_suite
    use test_compositions, only: compositions_suite
    use test_concise, only: concise_suite
    use test_console, only: console_suite
    use test_constant_accelerations, only: constant_accelerations_suite
    use test_constrained_modes, only: constrained_modes_suite
    use test_constrained_system, only: constrained_system_suite
    use test_constraints, only: constraints_suite
    use test_coupled_orders, only: coupled_orders_suite
    use test_course, only: course_suite
    use test_course_motions, only: course_motions_suite
    use test_course_orbits, only: course_orbits_suite
    use test_course_oscillators, only: course_oscillators_suite
    use test_cross_check, only: cross_check_suite
    use test_dalembert, only: dalembert_suite
    use test_decimal, only: decimal_suite
    use test_dense_orders, only: dense_orders_suite
    use test_dense_powers, only: dense_powers_suite
    use test_dense_run, only: dense_run_suite
    use test_derivation, only: derivation_suite
    use test_derivation_algebra, only: derivation_algebra_suite
    use test_derivation_rest, only: derivation_rest_suite
    use test_derivative, only: derivative_suite
    use test_differentials, only: differentials_suite
    use test_docs_formulae, only: docs_formulae_suite
    use test_dop853, only: dop853_suite
    use test_dop853_coefficients, only: dop853_coefficients_suite
    use test_dop853_control, only: dop853_control_suite
    use test_dop853_steps, only: dop853_steps_suite
    use test_double_pendulum, only: double_pendulum_suite
    use test_driven_pendulum, only: driven_pendulum_suite
    use test_echo, only: echo_suite
    use test_elliptic, only: elliptic_suite
    use test_errata, only: errata_suite
    use test_errata_ledger, only: errata_ledger_suite
    use test_errors, only: errors_suite
    use test_events, only: events_suite
    use test_exact_maps, only: exact_maps_suite
    use test_failure_contract, only: failure_contract_suite
    use test_film, only: film_suite
    use test_folding, only: folding_suite
    use test_forced_oscillation, only: forced_oscillation_suite
    use test_formula_fuzz, only: formula_fuzz_suite
    use test_formula_latex, only: formula_latex_suite
    use test_formula_parser, only: formula_parser_suite
    use test_formula_program, only: formula_program_suite
    use test_fortran_module, only: fortran_module_suite
    use test_gauge, only: gauge_suite
    use test_gauss, only: gauss_suite
    use test_gauss_adaptive, only: gauss_adaptive_suite
    use test_gauss_control, only: gauss_control_suite
    use test_gauss_dense, only: gauss_dense_suite
    use test_gauss_hertz, only: gauss_hertz_suite
    use test_gauss_tables, only: gauss_tables_suite
    use test_generalised_forces, only: generalised_forces_suite
    use test_geometric_phase, only: geometric_phase_suite
    use test_gnuplot, only: gnuplot_suite
    use test_gnuplot_scales, only: gnuplot_scales_suite
    use test_graded_responses, only: graded_responses_suite
    use test_grading, only: grading_suite
    use test_gsl, only: gsl_suite
    use test_gsl_odeiv, only: gsl_odeiv_suite
    use test_gyroscopic, only: gyroscopic_suite
    use test_hanging_chain, only: hanging_chain_suite
    use test_harness, only: harness_suite
    use test_helmholtz, only: helmholtz_suite
    use test_help, only: help_suite
    use test_hyperdual, only: hyperdual_suite
    use test_indexed_names, only: indexed_names_suite
    use test_integrator_orders, only: integrator_orders_suite
    use test_lanes, only: lanes_suite
    use test_lapack, only: lapack_suite
    use test_lapack_band, only: lapack_band_suite
    use test_least_time, only: least_time_suite
    use test_ledger_text, only: ledger_text_suite
    use test_letter_products, only: letter_products_suite
    use test_library_arguments, only: library_arguments_suite
    use test_library_calls, only: library_calls_suite
    use test_lyapunov_lanes, only: lyapunov_lanes_suite
    use test_machine, only: machine_suite
    use test_maupertuis, only: maupertuis_suite
    use test_measure_g, only: measure_g_suite
    use test_method_refusals, only: method_refusals_suite
    use test_method_structure, only: method_structure_suite
    use test_methods, only: methods_suite
    use test_mirror, only: mirror_suite
    use test_mode_picture, only: mode_picture_suite
    use test_mode_rounding, only: mode_rounding_suite
    use test_modes_files, only: modes_files_suite
    use test_motion_statements, only: motion_statements_suite
    use test_namelist, only: namelist_suite
    use test_namelist_limits, only: namelist_limits_suite
    use test_namelist_mistakes, only: namelist_mistakes_suite
    use test_namelist_refusals, only: namelist_refusals_suite
    use test_namelist_values, only: namelist_values_suite
    use test_noether, only: noether_suite
    use test_normal_modes, only: normal_modes_suite
    use test_npy, only: npy_suite
    use test_number_class, only: number_class_suite
    use test_number_text, only: number_text_suite
    use test_oscillator, only: oscillator_suite
    use test_other_rounding, only: other_rounding_suite
    use test_outcome, only: outcome_suite
    use test_output_failures, only: output_failures_suite
    use test_output_file, only: output_file_suite
    use test_overlay, only: overlay_suite
    use test_own_closed_form, only: own_closed_form_suite
    use test_own_system, only: own_system_suite
    use test_page_controls, only: page_controls_suite
    use test_page_formulae, only: page_formulae_suite
    use test_page_headings, only: page_headings_suite
    use test_pages, only: pages_suite
    use test_parameter_choice, only: parameter_choice_suite
    use test_parameter_domains, only: parameter_domains_suite
    use test_partial_files, only: partial_files_suite
    use test_pasted_characters, only: pasted_characters_suite
    use test_pasted_latex, only: pasted_latex_suite
    use test_pendulum, only: pendulum_suite
    use test_period, only: period_suite
    use test_phase_space, only: phase_space_suite
    use test_places, only: places_suite
    use test_plot_label, only: plot_label_suite
    use test_precision_curve, only: precision_curve_suite
    use test_principles, only: principles_suite
    use test_printed_formulae, only: printed_formulae_suite
    use test_printed_notes, only: printed_notes_suite
    use test_processes, only: processes_suite
    use test_progress, only: progress_suite
    use test_quadratic_eigen, only: quadratic_eigen_suite
    use test_random_draws, only: random_draws_suite
    use test_reactions, only: reactions_suite
    use test_reduced_motion, only: reduced_motion_suite
    use test_refusals, only: refusals_suite
    use test_register, only: register_suite
    use test_resources, only: resources_suite
    use test_rheonomic, only: rheonomic_suite
    use test_rolling_disk, only: rolling_disk_suite
    use test_rolling_disk_reference, only: rolling_disk_reference_suite
    use test_roots, only: roots_suite
    use test_rotating_reference, only: rotating_reference_suite
    use test_run, only: run_suite
    use test_run_disks, only: run_disks_suite
    use test_run_plan, only: run_plan_suite
    use test_same_motion_page, only: same_motion_page_suite
    use test_scene_files, only: scene_files_suite
    use test_scene_reference, only: scene_reference_suite
    use test_scene_steps, only: scene_steps_suite
    use test_scenes, only: scenes_suite
    use test_scorecard, only: scorecard_suite
    use test_second_run, only: second_run_suite
    use test_shipped_files, only: shipped_files_suite
    use test_sinc, only: sinc_suite
    use test_sine_cosine, only: sine_cosine_suite
    use test_sizes_of_motions, only: sizes_of_motions_suite
    use test_slow_sweeps, only: slow_sweeps_suite
    use test_small_angle, only: small_angle_suite
    use test_small_energies, only: small_energies_suite
    use test_small_oscillations, only: small_oscillations_suite
    use test_solve, only: solve_suite
    use test_statement, only: statement_suite
    use test_statement_forms, only: statement_forms_suite
    use test_step_warning, only: step_warning_suite
    use test_stress, only: stress_suite
    use test_stress_systems, only: stress_systems_suite
    use test_stress_texts, only: stress_texts_suite
    use test_sweep, only: sweep_suite
    use test_sweep_lanes, only: sweep_lanes_suite
    use test_sweep_points, only: sweep_points_suite
    use test_sweep_scenes, only: sweep_scenes_suite
    use test_sweep_store, only: sweep_store_suite
    use test_swings, only: swings_suite
    use test_systems, only: systems_suite
    use test_term_sizes, only: term_sizes_suite
    use test_text, only: text_suite
    use test_time_grid, only: time_grid_suite
    use test_typed_homeworks, only: typed_homeworks_suite
    use test_unfinished, only: unfinished_suite
    use test_usual_forms, only: usual_forms_suite
    use test_vakonomic, only: vakonomic_suite
    use test_value_range, only: value_range_suite
    use test_variational, only: variational_suite
    use test_virtual_work, only: virtual_work_suite
    use test_walls, only: walls_suite
    use test_which_forces, only: which_forces_suite
    use test_whole_file, only: whole_file_suite
    use test_work, only: work_suite
    use test_workers, only: workers_suite
    use test_written_mass, only: written_mass_suite
    use test_written_quantities, only: written_quantities_suite
    use test_written_refusals, only: written_refusals_suite
    use test_written_rotors, only: written_rotors_suite
    use test_written_system, only: written_system_suite
    use test_wrong_words, only: wrong_words_suite
    implicit none (type, external)
    private
    public :: load_tests

contains

    function load_tests() result(suite)
        !! All suites, in the order they run.
        type(TestSuite) :: suite

        suite = TestSuite("lagrangia")
        call suite%addTest(harness_suite())
        call suite%addTest(accuracy_suite())
        call suite%addTest(action_suite())
        call suite%addTest(amplitude_suite())
        call suite%addTest(audit_suite())
        call suite%addTest(audit_formulas_suite())
        call suite%addTest(auto_suite())
        call suite%addTest(bench_suite())
        call suite%addTest(bench_files_suite())
        call suite%addTest(blas_threads_suite())
        call suite%addTest(bouncing_ball_suite())
        call suite%addTest(brief_force_suite())
        call suite%addTest(canonical_suite())
        call suite%addTest(canonical_form_suite())
        call suite%addTest(canonical_maps_suite())
        call suite%addTest(cart_pendulum_suite())
        call suite%addTest(catalogue_suite())
        call suite%addTest(characters_suite())
        call suite%addTest(charged_particle_suite())
        call suite%addTest(charged_particle_reference_suite())
        call suite%addTest(columns_suite())
        call suite%addTest(command_line_suite())
        call suite%addTest(compensated_suite())
        call suite%addTest(compositions_suite())
        call suite%addTest(concise_suite())
        call suite%addTest(console_suite())
        call suite%addTest(constant_accelerations_suite())
        call suite%addTest(constrained_modes_suite())
        call suite%addTest(constrained_system_suite())
        call suite%addTest(constraints_suite())
        call suite%addTest(coupled_orders_suite())
        call suite%addTest(decimal_suite())
        call suite%addTest(dense_orders_suite())
        call suite%addTest(dense_powers_suite())
        call suite%addTest(dense_run_suite())
        call suite%addTest(derivation_suite())
        call suite%addTest(derivation_algebra_suite())
        call suite%addTest(derivation_rest_suite())
        call suite%addTest(docs_formulae_suite())
        call suite%addTest(dop853_suite())
        call suite%addTest(dop853_coefficients_suite())
        call suite%addTest(dop853_control_suite())
        call suite%addTest(dop853_steps_suite())
        call suite%addTest(derivative_suite())
        call suite%addTest(double_pendulum_suite())
        call suite%addTest(driven_pendulum_suite())
        call suite%addTest(echo_suite())
        call suite%addTest(elliptic_suite())
        call suite%addTest(course_suite())
        call suite%addTest(dalembert_suite())
        call suite%addTest(small_angle_suite())
        call suite%addTest(quadratic_eigen_suite())
        call suite%addTest(random_draws_suite())
        call suite%addTest(reactions_suite())
        call suite%addTest(refusals_suite())
        call suite%addTest(noether_suite())
        call suite%addTest(same_motion_page_suite())
        call suite%addTest(vakonomic_suite())
        call suite%addTest(maupertuis_suite())
        call suite%addTest(gauss_hertz_suite())
        call suite%addTest(geometric_phase_suite())
        call suite%addTest(measure_g_suite())
        call suite%addTest(all_paths_suite())
        call suite%addTest(which_forces_suite())
        call suite%addTest(phase_space_suite())
        call suite%addTest(errata_suite())
        call suite%addTest(errata_ledger_suite())
        call suite%addTest(errors_suite())
        call suite%addTest(events_suite())
        call suite%addTest(exact_maps_suite())
        call suite%addTest(failure_contract_suite())
        call suite%addTest(film_suite())
        call suite%addTest(folding_suite())
        call suite%addTest(formula_fuzz_suite())
        call suite%addTest(forced_oscillation_suite())
        call suite%addTest(formula_latex_suite())
        call suite%addTest(formula_parser_suite())
        call suite%addTest(formula_program_suite())
        call suite%addTest(fortran_module_suite())
        call suite%addTest(gauge_suite())
        call suite%addTest(gauss_suite())
        call suite%addTest(gauss_adaptive_suite())
        call suite%addTest(gauss_control_suite())
        call suite%addTest(gauss_dense_suite())
        call suite%addTest(gauss_tables_suite())
        call suite%addTest(generalised_forces_suite())
        call suite%addTest(gnuplot_suite())
        call suite%addTest(gnuplot_scales_suite())
        call suite%addTest(graded_responses_suite())
        call suite%addTest(grading_suite())
        call suite%addTest(gsl_suite())
        call suite%addTest(gsl_odeiv_suite())
        call suite%addTest(gyroscopic_suite())
        call suite%addTest(hanging_chain_suite())
        call suite%addTest(helmholtz_suite())
        call suite%addTest(hyperdual_suite())
        call suite%addTest(indexed_names_suite())
        call suite%addTest(integrator_orders_suite())
        call suite%addTest(lanes_suite())
        call suite%addTest(lapack_suite())
        call suite%addTest(lapack_band_suite())
        call suite%addTest(ledger_text_suite())
        call suite%addTest(least_time_suite())
        call suite%addTest(letter_products_suite())
        call suite%addTest(library_arguments_suite())
        call suite%addTest(library_calls_suite())
        call suite%addTest(lyapunov_lanes_suite())
        call suite%addTest(machine_suite())
        call suite%addTest(method_refusals_suite())
        call suite%addTest(method_structure_suite())
        call suite%addTest(methods_suite())
        call suite%addTest(mirror_suite())
        call suite%addTest(mode_picture_suite())
        call suite%addTest(mode_rounding_suite())
        call suite%addTest(modes_files_suite())
        call suite%addTest(namelist_suite())
        call suite%addTest(namelist_limits_suite())
        call suite%addTest(namelist_mistakes_suite())
        call suite%addTest(namelist_refusals_suite())
        call suite%addTest(namelist_values_suite())
        call suite%addTest(normal_modes_suite())
        call suite%addTest(npy_suite())
        call suite%addTest(number_class_suite())
        call suite%addTest(number_text_suite())
        call suite%addTest(oscillator_suite())
        call suite%addTest(outcome_suite())
        call suite%addTest(output_failures_suite())
        call suite%addTest(output_file_suite())
        call suite%addTest(overlay_suite())
        call suite%addTest(own_system_suite())
        call suite%addTest(page_controls_suite())
        call suite%addTest(page_formulae_suite())
        call suite%addTest(page_headings_suite())
        call suite%addTest(pages_suite())
        call suite%addTest(parameter_choice_suite())
        call suite%addTest(parameter_domains_suite())
        call suite%addTest(partial_files_suite())
        call suite%addTest(pasted_characters_suite())
        call suite%addTest(pasted_latex_suite())
        call suite%addTest(differentials_suite())
        call suite%addTest(motion_statements_suite())
        call suite%addTest(pendulum_suite())
        call suite%addTest(period_suite())
        call suite%addTest(places_suite())
        call suite%addTest(plot_label_suite())
        call suite%addTest(time_grid_suite())
        call suite%addTest(precision_curve_suite())
        call suite%addTest(principles_suite())
        call suite%addTest(printed_formulae_suite())
        call suite%addTest(printed_notes_suite())
        call suite%addTest(processes_suite())
        call suite%addTest(progress_suite())
        call suite%addTest(reduced_motion_suite())
        call suite%addTest(resources_suite())
        call suite%addTest(rheonomic_suite())
        call suite%addTest(rolling_disk_suite())
        call suite%addTest(rolling_disk_reference_suite())
        call suite%addTest(roots_suite())
        call suite%addTest(rotating_reference_suite())
        call suite%addTest(run_suite())
        call suite%addTest(run_disks_suite())
        call suite%addTest(run_plan_suite())
        call suite%addTest(scene_files_suite())
        call suite%addTest(scene_steps_suite())
        call suite%addTest(scene_reference_suite())
        call suite%addTest(scenes_suite())
        call suite%addTest(changed_scene_suite())
        call suite%addTest(scorecard_suite())
        call suite%addTest(help_suite())
        call suite%addTest(course_motions_suite())
        call suite%addTest(course_oscillators_suite())
        call suite%addTest(course_orbits_suite())
        call suite%addTest(cross_check_suite())
        call suite%addTest(other_rounding_suite())
        call suite%addTest(second_run_suite())
        call suite%addTest(shipped_files_suite())
        call suite%addTest(sinc_suite())
        call suite%addTest(slow_sweeps_suite())
        call suite%addTest(sine_cosine_suite())
        call suite%addTest(sizes_of_motions_suite())
        call suite%addTest(small_energies_suite())
        call suite%addTest(small_oscillations_suite())
        call suite%addTest(step_warning_suite())
        call suite%addTest(stress_suite())
        call suite%addTest(stress_systems_suite())
        call suite%addTest(stress_texts_suite())
        call suite%addTest(solve_suite())
        call suite%addTest(statement_suite())
        call suite%addTest(statement_forms_suite())
        call suite%addTest(sweep_suite())
        call suite%addTest(sweep_lanes_suite())
        call suite%addTest(sweep_points_suite())
        call suite%addTest(sweep_scenes_suite())
        call suite%addTest(sweep_store_suite())
        call suite%addTest(swings_suite())
        call suite%addTest(systems_suite())
        call suite%addTest(term_sizes_suite())
        call suite%addTest(text_suite())
        call suite%addTest(typed_homeworks_suite())
        call suite%addTest(unfinished_suite())
        call suite%addTest(usual_forms_suite())
        call suite%addTest(value_range_suite())
        call suite%addTest(variational_suite())
        call suite%addTest(virtual_work_suite())
        call suite%addTest(walls_suite())
        call suite%addTest(whole_file_suite())
        call suite%addTest(work_suite())
        call suite%addTest(workers_suite())
        call suite%addTest(wrong_words_suite())
        call suite%addTest(written_mass_suite())
        call suite%addTest(written_quantities_suite())
        call suite%addTest(written_refusals_suite())
        call suite%addTest(written_rotors_suite())
        call suite%addTest(written_system_suite())
        call suite%addTest(own_closed_form_suite())  ! the last two: their systems stay in the
        call suite%addTest(register_suite())         ! catalogue
    end function load_tests
end module suites
