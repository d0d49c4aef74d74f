"""What the CAM stage registers: posts and exporters."""

from mechwright.hookspecs import hookimpl
from mechwright.output import Exporter, Post
from mechwright_cam.exporters import DxfExporter, GlbExporter, StepExporter, StlExporter, ThreeMfExporter


@hookimpl
def mechwright_register_posts() -> list[type[Post]]:
    """The controls that programs can be written for."""
    from mechwright_cam.posts import FanucPost, GrblPost, HaasPost, LinuxCncPost, Mach3Post

    return [LinuxCncPost, FanucPost, HaasPost, Mach3Post, GrblPost]


@hookimpl
def mechwright_register_exporters() -> list[type[Exporter]]:
    """The file formats that parts can be written in."""
    return [StepExporter, DxfExporter, StlExporter, ThreeMfExporter, GlbExporter]
