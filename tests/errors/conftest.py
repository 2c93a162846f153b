"""Let pytest say what differs where `given.check` compares messages."""

import pytest

pytest.register_assert_rewrite("tests.errors.given")
