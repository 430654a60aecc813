//! Simulated machine and hardware for the excavator controller.
