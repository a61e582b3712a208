"""What a run did, for people who want the motion itself: summary, files, energies and spring forces over time."""
