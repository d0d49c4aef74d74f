"""Files of a print: plates, meshes, and the sheet."""
