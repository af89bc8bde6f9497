"""How a contact is solved: state -> temperature, krylov -> coupled; isothermal; budget -> continuation."""
