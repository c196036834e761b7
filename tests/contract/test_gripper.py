"""What a controller may rely on with any gripper: `drivers.interfaces.Gripper`."""


def test_jaws_that_close_on_a_part_come_to_hold_it(grippers):
    with grippers(part=True) as jaws:
        jaws.gripper.close()
        held = jaws.holds()
        assert held[-1]
        assert held == sorted(held)  # once held, it stays held


def test_jaws_that_close_on_nothing_hold_nothing(grippers):
    with grippers(part=False) as jaws:
        jaws.gripper.close()
        assert not any(jaws.holds())


def test_open_jaws_around_a_part_hold_nothing(grippers):
    with grippers(part=True) as jaws:
        jaws.gripper.open()
        assert not any(jaws.holds())


def test_opened_jaws_let_go(grippers):
    with grippers(part=True) as jaws:
        jaws.gripper.close()
        assert jaws.holds()[-1]
        jaws.gripper.open()
        assert not jaws.holds()[-1]


def test_closing_twice_is_closing(grippers):
    with grippers(part=True) as jaws:
        for _ in range(2):
            jaws.gripper.close()
            assert jaws.holds()[-1]


def test_what_was_let_go_in_its_place_can_be_gripped_again(grippers):
    with grippers(part=True) as jaws:
        for _ in range(2):
            jaws.gripper.close()
            assert jaws.holds()[-1]
            jaws.gripper.open()
            assert not jaws.holds()[-1]


def test_jaws_do_nothing_before_the_arms_next_command(grippers):
    with grippers(part=True) as jaws:
        jaws.gripper.close()
        jaws.gripper.open()
        assert not any(jaws.holds())
