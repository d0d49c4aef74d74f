"""What a person reads beside the programs."""
