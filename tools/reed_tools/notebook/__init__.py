"""What `import reed_tools` gives a notebook or a script: runs, recorded signals as arrays, sweeps, pictures."""
