"""The family of planar linkages: any links, pins and slides."""
