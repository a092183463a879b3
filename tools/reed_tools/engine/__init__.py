"""Many runs side by side: on this machine's cores or on a cluster, by Dask."""
