"""Laws of pairs, their motion and figures, over tables of designs."""
