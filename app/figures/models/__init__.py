"""What is drawn of each model's answers; nothing here knows how."""
