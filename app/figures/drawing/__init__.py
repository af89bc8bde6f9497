"""How a figure is drawn: style -> labels, scales -> canvas -> curves, annotations -> panels, maps, rows -> image."""
