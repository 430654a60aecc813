//! What is promised, and the tests that show it.

/// Something promised.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Requirement {
    /// Its number: `SR-01`.
    pub id: &'static str,
    /// What holds.
    pub text: &'static str,
    /// The tests that show it, by their functions' names; `file::name` where two files have one of that name.
    pub tests: &'static [&'static str],
}

const fn promise(id: &'static str, text: &'static str, tests: &'static [&'static str]) -> Requirement {
    Requirement { id, text, tests }
}

/// Every requirement. A number stays with its requirement for good; one that goes leaves a gap.
pub const REQUIREMENTS: &[Requirement] = &[
    promise(
        "SR-01",
        "Outside *running* every current is zero and the cut-off is open, whatever comes in.",
        &[
            "whatever_comes_in_outputs_are_finite_and_safe_outside_running",
            "the_whole_supervisor_opens_the_gate_only_while_running_whatever_comes_in_in_every_state",
            "every_state_with_every_set_of_facts_is_tried",
        ],
    ),
    promise(
        "SR-02",
        "*Running* begins only after a passed self-test, with levers in neutral and nothing wrong, by an enable switched on afresh.",
        &[
            "running_begins_only_from_ready_self_tested_in_neutral_by_a_fresh_enable_with_nothing_wrong",
            "without_self_test_neutral_enable_off_or_its_edge_running_is_never_reached",
            "an_enable_switch_found_on_at_power_up_enables_nothing",
            "levers_out_of_neutral_while_enabling_enable_nothing",
            "without_a_command_message_nothing_is_ever_enabled",
        ],
    ),
    promise(
        "SR-03",
        "Enable off stops in the same tick. Levers in neutral command zero currents.",
        &[
            "switching_enable_off_stops_in_the_same_tick_without_a_fault",
            "running_in_neutral_commands_zero_current",
            "releasing_the_lever_during_a_dig_commands_zero_at_once_and_starting_over_needs_the_start",
        ],
    ),
    promise(
        "SR-04",
        "Enable drops after 10 s in neutral without motion, and needs a fresh edge.",
        &["enable_drops_after_ten_seconds_of_neutral_without_motion_and_needs_a_fresh_edge"],
    ),
    promise(
        "SR-05",
        "A fault stops everything in the tick that names it and stays latched until levers are in neutral, its cause is gone, and enable is \
         switched on afresh. The first fault keeps its name and its freeze-frame.",
        &[
            "every_fault_stops_everything_in_the_same_tick_and_is_named",
            "a_fault_stays_latched_after_its_cause_is_gone_until_neutral_and_a_fresh_enable",
            "the_first_fault_keeps_its_name_when_others_follow",
            "the_freeze_frame_keeps_what_was_known_at_the_first_fault",
        ],
    ),
    promise(
        "SR-06",
        "Faults of memory, parameters and scheduling, those of the start-up tests, a welded cut-off and crossed coils are left only by a restart.",
        &[
            "exactly_the_faults_of_memory_scheduling_and_outputs_and_crossed_coils_need_a_restart",
            "a_fault_is_latched_in_every_state_and_a_grave_one_until_the_restart",
            "a_fault_that_needs_a_restart_takes_the_name_of_one_that_does_not",
            "every_state_is_reached_and_only_stopped_is_never_left",
        ],
    ),
    promise(
        "SR-07",
        "The emergency stop acts in every state and in the same tick; a broken wire is a pressed one.",
        &["an_emergency_stop_acts_in_every_state", "a_broken_emergency_stop_wire_is_a_pressed_one"],
    ),
    promise(
        "SR-08",
        "A failed or missing step of the start-up self-test enables nothing and is named: drivers, cut-off, converters.",
        &[
            "a_failed_or_missing_step_of_the_self_test_enables_nothing_and_is_named",
            "a_fault_during_the_self_test_does_not_get_round_it",
            "a_driver_that_does_not_obey_or_leaks_current_with_the_cut_off_open_fails",
            "a_cut_off_whose_contact_does_not_follow_fails",
            "a_converter_that_does_not_answer_fails_both",
        ],
    ),
    promise(
        "SR-09",
        "A cut-off that does not follow, welded or stuck open, is named in the 51st tick.",
        &[
            "a_cut_off_that_does_not_follow_is_a_fault_after_fifty_ticks_and_not_before",
            "a_cut_off_s_contact_may_be_elsewhere_for_fifty_ticks_then_it_is_stuck_open_or_welded",
        ],
    ),
    promise(
        "SR-10",
        "A command that is lost, or whose counter is frozen or checksum wrong, counts for 100 ms after the last good one and stops the machine then.",
        &[
            "a_command_runs_out_after_exactly_the_timeout",
            "a_frozen_counter_runs_out_and_says_so",
            "wrong_checksums_run_out_and_say_so_and_then_silence_is_silence",
            "a_silent_operator_or_one_without_his_levers_is_a_stale_command",
            "a_stale_command_stops_motion_in_the_same_tick",
        ],
    ),
    promise(
        "SR-11",
        "Nothing but a good message of the configured sender is a command: no random frame, replayed handful, turned bit or other message.",
        &[
            "nothing_random_is_taken_for_a_protected_message",
            "a_replayed_handful_never_counts",
            "any_bit_turned_in_a_good_message_is_seen",
            "every_error_of_up_to_three_bits_is_seen",
            "no_message_speaks_for_another",
            "only_the_configured_sender_is_heard",
        ],
    ),
    promise(
        "SR-12",
        "A position sensor that is out of its valid codes, jumps by 4 mm or more, or reads garbage is named within 20 ms.",
        &[
            "a_sensor_out_of_range_is_named_in_the_same_tick",
            "a_jump_of_four_millimetres_or_more_is_named_in_the_same_tick",
            "garbage_codes_are_a_jump_within_two_ticks",
        ],
    ),
    promise(
        "SR-13",
        "A stuck position sensor is named within 200 ms after 5 mm of motion that must have happened: by its lost noise, or by pressure.",
        &[
            "a_sensor_frozen_at_rest_is_named_after_the_command_that_should_have_moved_it",
            "a_sensor_frozen_in_motion_is_named",
            "a_sensor_that_stands_with_its_noise_is_named_when_the_pressure_says_that_nothing_stalls",
        ],
    ),
    promise(
        "SR-14",
        "Motion without or against its command is named within 100 ms after its measured speed leaves what a healthy machine may do; of a spool that \
         stays open within 202 ms after its cylinder has gone on for longer than it could ring, as the model's window may be 102 ms longer than the dead time.",
        &[
            "motion_without_any_command_is_named_within_a_tenth_of_a_second_of_being_measured",
            "motion_against_the_command_is_named_within_a_tenth_of_a_second_of_leaving_the_envelope",
            "a_spool_stuck_open_is_named_when_its_cylinder_goes_on_longer_than_it_could_ring",
            "a_swing_s_valve_stuck_open_is_named_when_the_longest_run_on_is_over",
        ],
    ),
    promise(
        "SR-15",
        "One sensor's good value clears no fault of another.",
        &[
            "one_sensors_good_value_does_not_clear_anothers_fault",
            "one_sensor_s_good_value_clears_no_fault_of_another",
            "one_pressure_sensors_failure_is_not_the_others",
        ],
    ),
    promise(
        "SR-16",
        "A coil's short or cross is named within 20 ms, an open wire within 50 ms, from the tick it can be seen.",
        &[
            "every_fault_is_called_what_it_is_in_its_time_at_any_supply_and_temperature",
            "a_broken_coil_stops_everything_and_is_named",
            "two_currents_in_one_spool_are_a_cross_where_each_alone_could_be_right",
        ],
    ),
    promise(
        "SR-17",
        "Both solenoids of a spool are never on together, and a closed gate gives no duty from that tick on.",
        &[
            "both_solenoids_are_never_on_together",
            "a_coil_that_does_not_let_go_keeps_the_other_off_for_good",
            "a_closed_gate_gives_no_duty_from_that_tick_on",
        ],
    ),
    promise(
        "SR-18",
        "A supply out of range, battery's or sensors', and a converter that does not answer soundly stop the machine in the same tick.",
        &[
            "every_fault_stops_everything_in_the_same_tick_and_is_named",
            "a_sensor_supply_outside_its_range_stops_everything_and_is_named",
            "a_converter_that_answers_unsoundly_stops_the_machine_by_name",
            "broken_converters_switches_and_read_backs_stop_the_machine_by_name",
            "every_break_is_seen_in_the_scan_it_happens_and_named",
        ],
    ),
    promise(
        "SR-19",
        "A late tick is told in the same cycle; three in a row stop the machine until a restart.",
        &[
            "one_late_tick_is_told_in_the_same_cycle_and_stops_nothing",
            "fewer_than_three_overruns_in_a_row_stop_nothing_three_do_until_the_restart",
        ],
    ),
    promise(
        "SR-20",
        "The watchdog is fed once a complete cycle and not when an output fails, which takes the others down with it.",
        &["the_watchdog_is_fed_once_a_cycle_and_not_when_an_output_fails"],
    ),
    promise(
        "SR-21",
        "Panic, hard fault, stack overflow and an interrupt nobody expects end with the cut-off open and the outputs off.",
        &[
            "panic_hard_fault_stack_overflow_and_strange_interrupts_end_with_the_outputs_off",
            "an_image_that_does_not_fail_touches_no_output",
        ],
    ),
    promise(
        "SR-22",
        "No panic is reachable from the control tick; on the board's image it takes at most 4 KiB of stack, and there is more.",
        &["the_control_task_reaches_no_panic_and_calls_nothing_unknown", "the_stack_has_a_bound_and_room_to_spare"],
    ),
    promise(
        "SR-23",
        "A power cut at any byte of a write of the parameters leaves the old record or the new one; a spoilt copy is seen by its CRC.",
        &[
            "a_cut_at_any_byte_leaves_the_old_record_or_the_new_one",
            "a_second_cut_in_the_repair_of_the_first_still_leaves_a_record",
            "a_first_write_that_is_cut_leaves_nothing_that_is_taken_for_a_record",
            "a_flipped_bit_anywhere_in_one_copy_leaves_the_other",
            "random_bytes_are_no_record_and_no_panic",
            "a_parameter_record_spoilt_in_both_copies_is_refused_before_anything_moves",
        ],
    ),
    promise(
        "SR-24",
        "Parameters nobody signed off are neither written nor loaded; only a board proved disabled writes; a value out of its range is refused.",
        &[
            "a_record_nobody_signed_off_is_neither_written_nor_loaded",
            "only_a_board_that_cannot_move_may_write",
            "parameters::every_value_out_of_its_range_is_refused_by_name",
        ],
    ),
    promise(
        "SR-25",
        "Host and emulated controller give the same bits in every scenario, so that a test on the host is one of the image's too.",
        &["host_and_emulator_agree_on_every_output_bit_of_every_scenario", "no_image_has_a_fused_multiply_add"],
    ),
    promise(
        "SR-26",
        "Before a configured fence the linkage is slowed; no part of it passes on the simulated machine under random operators.",
        &[
            "sixty_random_operators_never_carry_the_linkage_past_a_limit_and_a_fence_of_the_tip_alone_lets_them",
            "what_is_let_through_lies_between_nothing_and_what_was_wanted_and_keeps_every_bound",
            "inside_a_limit_the_way_out_is_free_and_the_way_in_is_closed",
            "planes_and_balls_are_kept_from_wherever_the_actuators_have_moved_to_since_they_were_weighed",
        ],
    ),
    promise(
        "SR-27",
        "Healthy actuators, coils and sensors do not trip in an hour of random levers: delayed, ringing, stalling, noisy, hot and cold.",
        &[
            "an_hour_of_random_levers_on_delayed_ringing_stalling_cylinders_trips_nothing",
            "an_hour_of_random_levers_on_the_harness_s_plant_trips_nothing",
            "a_cylinder_that_slows_down_as_late_and_slowly_as_it_may_and_rings_the_while_trips_nothing_one_that_goes_on_does",
            "a_machine_that_stands_still_for_ten_minutes_with_noise_neither_trips_nor_counts_as_moving",
            "a_healthy_coil_never_has_a_fault",
        ],
    ),
    promise(
        "SR-28",
        "A bit that turns by itself among the watched constants that the parameters became stops the machine until a restart, within a round of the \
         watch; a timer that is lost for ever ends by the watchdog after 50 ms; one lost tick changes next to nothing.",
        &["turned_bits_of_constants_and_a_lost_timer_end_with_the_outputs_off_and_are_named"],
    ),
    promise(
        "SR-29",
        "Whatever bytes come by CAN, as a parameter record, a machine or scenario file, or from either end of the emulator's link: no panic, no NaN \
         in an output, nothing driven behind a closed gate, and what is refused is named.",
        &[
            "can_frames_never_panic_and_leave_no_nan",
            "parameter_records_are_refused_by_name_or_run_without_a_nan",
            "machine_files_are_refused_by_name_or_give_a_pose",
            "scenario_files_are_refused_by_name_or_run_without_a_nan",
            "both_ends_of_the_emulator_link_take_any_bytes",
            "every_target_has_its_file_its_corpus_and_its_function",
        ],
    ),
];
