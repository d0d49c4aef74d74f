"""What stands in the workshop: cutters, machines, and the settings of a job."""
