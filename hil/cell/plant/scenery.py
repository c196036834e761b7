"""Light, camera and table: seen in pictures, felt by nothing."""

import mujoco

CLOSE_UP = "close_up"
"""Camera that looks at its subject from 5 cm, over the cable's broad side."""


def add_scenery(spec: mujoco.MjSpec, subject: str) -> None:
    """Add them; the close-up looks at the body of that name."""
    spec.visual.global_.offwidth = 1280
    spec.visual.global_.offheight = 960
    spec.visual.map.znear = 0.01
    spec.stat.extent = 0.05
    spec.stat.center = [0.0, 0.0, 0.0]
    spec.worldbody.add_light(pos=[0.05, -0.1, 0.1], dir=[-0.4, 0.8, -0.8])
    spec.worldbody.add_camera(
        name=CLOSE_UP,
        pos=[0.022, -0.036, 0.022],
        mode=mujoco.mjtCamLight.mjCAMLIGHT_TARGETBODY,
        targetbody=subject,
    )
    spec.add_texture(
        name="sky",
        type=mujoco.mjtTexture.mjTEXTURE_SKYBOX,
        builtin=mujoco.mjtBuiltin.mjBUILTIN_GRADIENT,
        rgb1=[0.75, 0.80, 0.85],
        rgb2=[0.35, 0.38, 0.42],
        width=64,
        height=64,
    )
