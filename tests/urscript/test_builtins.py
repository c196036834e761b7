import pytest


@pytest.mark.parametrize(
    ("expression", "printed"),
    [
        ("2.123456123456", "2.12346"),
        ("1.0", "1"),
        ("[True, False, 1]", "[True, False, 1]"),
        ("p[1, 2.5, 3, 0, 0, 0]", "p[1, 2.5, 3, 0, 0, 0]"),
        ('str_cat("a", 1)', "a1"),
        ('str_len("four")', "4"),
        ('str_sub("pallet", 1, 3)', "all"),
        ('str_find("pallet", "let")', "3"),
        ('str_find("pallet", "x")', "-1"),
        ('to_num("-12") + to_num("0.5")', "-11.5"),
        ("get_list_length([1, 2, 3])", "3"),
        ("norm([3, 4])", "5"),
        ("norm(-2.5)", "2.5"),
        ("floor(-1.5)", "-2"),
        ("ceil(1.2)", "2"),
        ("pow(2, 3)", "8"),
        ("log(2, 8)", "3"),
        ("atan2(1, 1) * 4 - acos(-1)", "0"),
        ("binary_list_to_integer([True, False, True])", "5"),
        ("integer_to_binary_list(-1)[31]", "True"),
        ("get_steptime()", "0.008"),
        ("force()", "13"),
        ("get_inverse_kin_has_solution(p[5, 0, 0, 0, 0, 0])", "False"),
        ("get_inverse_kin(p[0.5, 0, 0, 0, 0, 0], qnear = [0, 0, 0, 0, 0, 0])[0]", "0.5"),
        ("get_forward_kin([0.1, 0, 0, 0, 0, 0])", "p[0.1, 0, 0, 0, 0, 0]"),
        ("is_steady()", "True"),
    ],
)
def test_builtin_gives(said, expression, printed):
    assert said(f"textmsg({expression})") == [printed]


def test_string_cannot_grow_without_bound(run):
    runtime = run('s = "ab"\nwhile True:\n  s = str_cat(s, s)\nend')
    assert "longer than 1023" in runtime.error.message


def test_sleep_takes_its_time_in_whole_cycles(robot, run):
    run("sleep(0.02)")
    assert robot.t == 4 * robot.period  # three cycles asleep, the fourth ends the program


def test_blocking_popup_waits_for_a_person_who_never_comes(robot, run):
    runtime = run('popup("door?", title = "Stop", blocking = True)\ntextmsg("on")', cycles=50)
    assert robot.messages == ["Stop: door?"]
    assert runtime.error is None
