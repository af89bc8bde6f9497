"""The teeth of one mesh: geometry -> kinematics -> limits; balance -> loads."""
