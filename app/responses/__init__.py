"""What is answered: the results of the HTTP contract, converted from SI."""
