"""What a contact does below the surface: stress at points of a body, its maxima, its files."""
