"""From parts to proven programs: planning, posts, interpreter, proof and exporters."""
