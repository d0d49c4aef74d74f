"""The add-on for FreeCAD: a panel that shows a design and has its programs written.

FreeCAD has a geometry kernel of its own, so the add-on runs this program as another process. The files in
``addon`` are copied into FreeCAD's folder and run there, on FreeCAD's own Python.
"""
