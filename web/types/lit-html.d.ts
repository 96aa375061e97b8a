/** The page is served lit-html beside its own modules. */
export * from 'lit-html';
