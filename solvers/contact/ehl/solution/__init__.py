"""How a contact is solved: state -> temperature, krylov -> step -> coupled; isothermal; budget -> continuation."""
