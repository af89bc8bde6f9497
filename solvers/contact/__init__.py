"""Line contacts: dry contact, film thickness and flash temperature by formula, and the numerical solution (ehl)."""
