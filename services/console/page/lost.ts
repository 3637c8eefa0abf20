import { createContext } from 'react';

// The page has lost its console: what it shows is old, and what it says reaches nobody.
export const Lost = createContext(false);
