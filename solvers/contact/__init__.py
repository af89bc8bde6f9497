"""Line contacts: formulas for dry contact, film thickness and flash temperature; numerical solution in `ehl`."""
