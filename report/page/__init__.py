"""The report's page: its sections, what it says first, engine cards, what is kept between runs."""
