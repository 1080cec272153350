import react from "@vitejs/plugin-react";
import { defineConfig } from "vite";

// The built page is committed: no source maps, nothing that differs between machines; hashes in the names of the files
// let the server have them kept for good.
export default defineConfig({
  base: "./",
  plugins: [react()],
  build: {
    outDir: "../static",
    emptyOutDir: true,
    target: "es2022",
    modulePreload: false,
    license: { fileName: "licences.md" },
    rolldownOptions: {
      output: { entryFileNames: "assets/studio-[hash].js", assetFileNames: "assets/studio-[hash][extname]" },
    },
  },
});
