"""What a wrong submission does in cases made to show one thing each."""
