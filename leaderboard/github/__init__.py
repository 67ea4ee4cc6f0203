"""Sending a submission to GitHub as a pull request; what talks to the network is imported only to send."""
