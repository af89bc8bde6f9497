"""Names of the literature that quantities refer to."""

PAHL = "Pahl 1978"
MILIAN = "Milian 2004"
XUE = "Xue 2020"
ISO_21771 = "ISO 21771"
ISO_6336 = "ISO 6336-1"
OCVIRK = "DuBois and Ocvirk, NACA 1157"
API_613 = "API 613, 5th ed."
