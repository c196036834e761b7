"""The dashboard client against a robot of few words and against strangers."""

import socket
import threading

import pytest

from drivers.errors import LinkError, ProtocolError, RobotStateError
from drivers.ur.dashboard import Dashboard


@pytest.fixture
def dashboard(served):
    dashboard = Dashboard("127.0.0.1", served.ports.dashboard, 5.0)
    yield dashboard
    dashboard.close()


def test_a_command_opens_the_connection_and_is_heard(dashboard, robot):
    dashboard.power_on()
    dashboard.stop()
    assert robot.dashboard_lines == ["power on", "stop"]


def test_an_early_unlock_is_not_an_error(dashboard, robot):
    robot.safety_mode, robot.refusals = 3, 1
    assert not dashboard.unlock_protective_stop()
    assert dashboard.unlock_protective_stop()


@pytest.mark.parametrize("act", ["power_on", "unlock_protective_stop"])
def test_an_unexpected_answer_is_quoted(dashboard, robot, act):
    robot.dashboard = lambda line: "Failed"
    with pytest.raises(RobotStateError, match="'Failed'"):
        getattr(dashboard, act)()


@pytest.fixture
def stranger():
    """A server that says one thing and hangs up; yields its port for what it shall say."""
    threads = []
    with socket.create_server(("127.0.0.1", 0)) as listener:

        def saying(words):
            def run():
                client, _ = listener.accept()
                with client:
                    client.sendall(words)

            threads.append(threading.Thread(target=run))
            threads[-1].start()
            return listener.getsockname()[1]

        yield saying
        for thread in threads:
            thread.join()


@pytest.mark.parametrize(
    ("words", "error", "match"),
    [
        (b"SSH-2.0-OpenSSH\r\n", ProtocolError, "SSH-2.0"),
        (b"", LinkError, "closed"),
        (bytes(5000), ProtocolError, "5000 bytes|4096 bytes"),
    ],
)
def test_a_port_without_a_dashboard_is_told_from_one(stranger, words, error, match):
    dashboard = Dashboard("127.0.0.1", stranger(words), 5.0)
    with pytest.raises(error, match=match):
        dashboard.power_on()
    dashboard.close()
