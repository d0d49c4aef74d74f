"""From parts to proven programs: planning, controls, proof and pages."""
