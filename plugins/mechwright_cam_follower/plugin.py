"""What this plugin registers."""

from mechwright import Plugin, hookimpl
from mechwright_cam_follower.family import CamFollower


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The mechanism family."""
    return [CamFollower]
