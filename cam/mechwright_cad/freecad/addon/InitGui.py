"""The workbench Mechwright. FreeCAD executes this file: names of its top do not reach into methods."""

import FreeCADGui


class MechwrightWorkbench(FreeCADGui.Workbench):  # type: ignore[misc] # FreeCAD has no types
    """One command: the panel."""

    MenuText = "Mechwright"
    ToolTip = "A design file: its parts, its motion, its programs"

    def Initialize(self) -> None:
        """Register the command, when the workbench is chosen first."""
        import mechwright_panel

        mechwright_panel.register()
        self.appendToolbar("Mechwright", [mechwright_panel.COMMAND])
        self.appendMenu("Mechwright", [mechwright_panel.COMMAND])

    def GetClassName(self) -> str:
        """The class of FreeCAD that stands behind a workbench in Python."""
        return "Gui::PythonWorkbench"


FreeCADGui.addWorkbench(MechwrightWorkbench())
