"""The load on the contact lines: contact_slices -> position_balance, line_survey -> load_balance, face_response."""
