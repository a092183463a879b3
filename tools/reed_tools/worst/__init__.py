"""The worst case of a campaign, searched for instead of waited for."""
