"""The unloaded flanks in the plane of action: contact_lines; tables -> modification -> loaded_zones."""
