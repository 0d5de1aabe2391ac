//! What happens where a solution meets interfaces, case by case: the complaints about event handling
//! that come back in every forum of the field, what is common elsewhere, what is done here, and the
//! test that shows it.
//!
//! The tests are in `tests/tests` and `tests/long` of the repository; `cargo test -p dmm-tests -p
//! dmm-long-tests NAME` runs one. One rule holds for every method; a method that cannot keep one does
//! not compile with it (a [`Locator`](crate::Locator) belongs to one-step methods alone, for example).
//!
//! # Crossings
//!
//! | complaint | common elsewhere | here | test |
//! |---|---|---|---|
//! | two crossings in one step are missed | signs are compared at the ends of steps | both are found: by slopes and bounds, or enclosures | `a_dip_within_one_step_is_two_transitions`, `every_root_of_a_step_is_found` |
//! | a switching function that waves in time is missed | steps follow the state alone | every zero along the dense output | `every_zero_of_a_wave_of_the_time_is_met` |
//! | interfaces that are close together are jumped over | the first sign change counts | crossed one after the other | `sheets_that_are_close_are_crossed_one_after_the_other` |
//! | an event fires again at the point where it was found | the state is moved a little | the mode is explicit; the root at its entry is divided off | `the_located_point_does_not_fire_again`, `the_root_at_the_entry_is_not_located_again` |
//! | the wrong side after an event | the side is read off the sign of g | x̂* belongs to the mode entered, whatever rounding did | `a_start_on_the_interface_is_decided_by_the_rates` |
//! | a zero exactly at the end of a step or at an output time is found twice or not at all | it depends on rounding | steps are half-open, (t_k, t_{k+1}]: a transition there, once | `a_zero_at_the_end_of_a_step_is_one_transition_there` |
//! | a zero at the end time | lost | a transition of the last step | `a_zero_at_the_end_time_belongs_to_the_last_step` |
//! | a tangential touch switches | a sign of rounding decides | no transition; counted | `a_tangential_touch_is_no_transition` |
//! | a near miss switches | the tolerance of the root finder | nothing happens | `a_near_miss_is_nothing` |
//! | a touch that becomes two crossings under a small change | found at one size of the step and lost at another | told apart to rounding | `a_turn_just_behind_an_interface_crosses_it_twice_or_touches_it` |
//! | the order falls to 1 at events | the crossing is located to the step's error, or interpolated | the method's own map is solved for g = 0 | `every_scheme_goes_through_the_quadrants_at_its_order` |
//! | energy drifts through events | nothing is conserved across the location | ψ keeps its level to (t̂*, x̂*) and has a new one behind it | `a_million_elastic_impacts_keep_the_energy` |
//! | output at an event is on one side of it, or in between | dense output crosses the corner | the time stands twice, with both modes | `points_at_a_transition_are_one_sided` |
//! | output times change the result | they are steps | they are not | `output_times_do_not_change_the_steps` |
//! | g without a value, or a wave without end | no event | [`ErrorKind::Undecided`](crate::ErrorKind::Undecided) says where | `a_switching_function_without_a_value_is_told` |
//!
//! # Starts, and several interfaces
//!
//! | complaint | common elsewhere | here | test |
//! |---|---|---|---|
//! | a start on an interface fires at once, or never | the event at t₀ is ignored, or is the first one | the rates dg/dt of both sides decide | `a_start_on_the_interface_is_decided_by_the_rates` |
//! | a start that both fields lead away from | one solution is taken | refused until a region is named | `an_ambiguous_start_follows_the_region_that_is_named` |
//! | two events at once | the first in the list wins | the mode whose own field fits at every interface | `three_interfaces_are_crossed_at_once` |
//! | the result depends on the order of the events | yes | no | `nothing_depends_on_the_order_of_declaration` |
//! | a corner that no field or several lead away from | something happens | a typed error with the interfaces | `a_corner_that_several_fields_or_none_lead_away_from_is_an_error` |
//! | `if`, `abs` or `sign` in the right-hand side costs the order, or the step size collapses | it is smoothed, or integrated over | each is an interface with the name of its formula | `a_switch_is_crossed_like_an_interface` |
//! | 2^m cases for m switches | written out, or one field without events | one field, whose switches are constants of the mode | `eleven_switches_are_one_field`, `twenty_blocks_stick_and_slip` |
//!
//! # Jumps
//!
//! | complaint | common elsewhere | here | test |
//! |---|---|---|---|
//! | a relay with memory, a converter with a latch | global variables in callbacks | `discrete` states, part of the mode | `hysteresis_remembers_what_it_met` |
//! | a reset leaves the state on the interface, and fires again | a flag in the callback | it does not happen again at the point that it has led to | `a_ball_bounces_with_every_scheme` |
//! | events at once assign in the order of the list | the last one wins | all see the values before; a contradiction is an error | `a_corner_turns_both_velocities`, `events_at_once_must_agree` |
//! | an event at a time is met by a step or not | by restarting | at the double nearest to it | `events_in_time_are_met_exactly` |
//! | a state that an event stops on its interface fires without end | yes | it rests there, on the side that it came from | `what_an_event_stops_rests_on_its_interface` |
//! | a bouncing ball ends in an endless loop, or falls through the floor | yes | [`ErrorKind::Zeno`](crate::ErrorKind::Zeno), with all that came before | `bounces_that_accumulate_end_as_an_error` |
//! | going back over an event | another trajectory | refused with events and sliding; else the same way back | `every_method_comes_back` |
//!
//! # Sliding
//!
//! | complaint | common elsewhere | here | test |
//! |---|---|---|---|
//! | chattering: ever smaller steps where both fields point at the interface | yes | the mean of the fields (Filippov), where that is declared | `stick_and_slip_times_are_those_of_the_reference` |
//! | … where nobody thought of it | a run that never ends | [`ErrorKind::Sliding`](crate::ErrorKind::Sliding) with both rates | `sliding_that_is_not_declared_is_an_error` |
//! | a sliding solution drifts off its surface | stabilised, to a tolerance | g is conserved, to rounding for ever | `rounding_errors_of_a_hundred_thousand_sliding_steps_do_not_add_up` |
//! | the end of sliding is late | at the next step | the weight's zero is located like a crossing | `dry_friction_as_a_switch_of_a_formula` |
//! | sliding ends at a touch of the next orbit | undefined | the exit is a root of its own; the touch is none | `a_refuge_keeps_the_prey_at_its_threshold` |
//! | sliding on several surfaces at once | not supported, or one after the other | one linear system for the weights that depend on one another | `two_curved_surfaces_lead_to_their_intersection`, `three_regions_meet_in_one_mean` |
//! | several means of four fields | one is taken | refused | `four_fields_without_one_mean_are_refused` |
