"""Operations: how one feature is cut."""
