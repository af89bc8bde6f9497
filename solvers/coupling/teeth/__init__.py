"""The teeth of one mesh: geometry -> kinematics -> limits; torque_balance -> floating_balance -> loads; peaks."""
